"""What the actuators carry: the weight of the robot and of its cable, and the socket's reaction.

Virtual work, quasi-static, without friction. A carriage moves along the rail only, so the middle of
a leg bar rises by half of what V rises: of the three bars (AB, DF, CE) half the weight hangs on V.
With the mass m_V on the platform, m_S on the slide (cable included) and m_bar of one bar, the robot
has to push V up with g (m_V + m_S + 1.5 m_bar), and its slide along the insertion axis with the
axial force plus g m_S sin(theta). While the plug is pushed with F, the platform also holds the
lateral part F sin(theta) of it.
"""

from __future__ import annotations

import math
from enum import StrEnum
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha, gamma
from twin.statics.actuators import JointForces, alpha_actuator_forces, alpha_actuator_forces_many

Array = NDArray[np.float64]
Mass = Annotated[float, Field(ge=0, le=1000, allow_inf_nan=False)]
Force = Annotated[float, Field(ge=0, le=10_000, allow_inf_nan=False)]

GRAVITY_M_S2 = 9.80665


class LoadCase(StrEnum):
    """What the plug is doing."""

    HOLDING = "holding"
    INSERTING = "inserting"
    WITHDRAWING = "withdrawing"


class Loads(BaseModel):
    """Masses that the carriages hold, and the forces at the plug.

    The cable and the forces are the paper's; it gives no other masses, so those are this project's
    own estimates.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    platform_mass_kg: Mass = Field(2.0, description="on the platform: slide's base, motor, camera")
    slide_mass_kg: Mass = Field(1.0, description="what rho3 moves: plug and its holder")
    bar_mass_kg: Mass = Field(0.3, description="each of the three leg bars")
    cable_mass_kg: Mass = Field(1.4, description="the charging cable")
    cable_length_mm: float = Field(
        1500.0, gt=0, le=20_000, description="of the cable from the station to the plug"
    )
    cable_share: float = Field(
        0.5, ge=0, le=1, description="of the cable's weight that hangs on the plug"
    )
    insertion_force_n: Force = Field(70.0, description="along the axis, out of the wall")
    withdrawal_force_n: Force = Field(70.0, description="along the axis, to the wall")

    @property
    def on_slide_kg(self) -> float:
        """Mass that moves with rho3 [kg]."""
        return self.slide_mass_kg + self.cable_share * self.cable_mass_kg

    @property
    def on_platform_kg(self) -> float:
        """Mass that counts at V: everything that rises with it, and half of the bars [kg]."""
        return self.platform_mass_kg + self.on_slide_kg + 1.5 * self.bar_mass_kg

    def axial_force_n(self, case: LoadCase) -> float:
        """Force of the plug on the socket along the insertion axis [N], positive pushing."""
        return {
            LoadCase.HOLDING: 0.0,
            LoadCase.INSERTING: self.insertion_force_n,
            LoadCase.WITHDRAWING: -self.withdrawal_force_n,
        }[case]


DEFAULT_LOADS = Loads()


def platform_push_n(geometry: RobotGeometry, loads: Loads, case: LoadCase) -> float:
    """Force along +y with which the carriages have to push V [N]."""
    weight_n = GRAVITY_M_S2 * loads.on_platform_kg
    return weight_n + loads.axial_force_n(case) * math.sin(geometry.theta_rad)


def slide_thrust_n(geometry: RobotGeometry, loads: Loads, case: LoadCase) -> float:
    """Force of the slide's actuator along +rho3 [N]; the same at every position."""
    weight_n = GRAVITY_M_S2 * loads.on_slide_kg
    return loads.axial_force_n(case) + weight_n * math.sin(geometry.theta_rad)


def actuator_loads(
    geometry: RobotGeometry, joints: JointPosition, loads: Loads, case: LoadCase
) -> JointForces:
    """Forces that the three actuators hold at a pose [N], positive along growing rho.

    Raises:
        LegsCannotCloseError: no pose has these joints, or the legs are folded flat.
    """
    v = gamma.platform(geometry, joints)
    legs = alpha.leg_vectors(geometry, v, joints.rho1_mm, joints.rho2_mm)
    carriages = alpha_actuator_forces(legs, 0.0, platform_push_n(geometry, loads, case))
    return JointForces(*carriages, slide_thrust_n(geometry, loads, case))


def actuator_loads_many(
    geometry: RobotGeometry, joints_mm: Array, loads: Loads, case: LoadCase
) -> Array:
    """Forces that the three actuators hold at many poses.

    Args:
        geometry: The robot.
        joints_mm: Joint positions, shape (..., 3) or only (rho1, rho2), shape (..., 2) [mm].
        loads: Masses and forces.
        case: What the plug is doing.

    Returns:
        Forces [N], shape (..., 3); NaN where `actuator_loads` would raise.
    """
    push_n = platform_push_n(geometry, loads, case)
    carriages = alpha_actuator_forces_many(geometry, joints_mm[..., :2], 0.0, push_n)
    thrust_n = np.where(np.isnan(carriages[..., :1]), np.nan, slide_thrust_n(geometry, loads, case))
    return np.concatenate((carriages, thrust_n), axis=-1)
