"""What the actuators carry along a whole motion, against what they can."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.kinematics.errors import LegsCannotCloseError
from twin.motion.plan import MotionPlan
from twin.statics.limits import DEFAULT_LIMITS, ActuatorLimits
from twin.statics.loads import DEFAULT_LOADS, LoadCase, Loads, actuator_loads_many


@dataclass(frozen=True, slots=True)
class WorstForce:
    """Where an actuator carries most.

    Attributes:
        joint: "rho1", "rho2" or "rho3".
        force_n: With its sign, positive along growing rho.
        limit_n: Largest magnitude allowed.
        time_s: From the start of the plan.
        joints: Joint positions there.
    """

    joint: str
    force_n: float
    limit_n: float
    time_s: float
    joints: JointPosition

    @property
    def margin_n(self) -> float:
        """What is left to the limit [N]; negative beyond it."""
        return self.limit_n - abs(self.force_n)

    @property
    def utilisation(self) -> float:
        """Share of the limit that is used, 1 on it."""
        return abs(self.force_n) / self.limit_n


@dataclass(frozen=True, slots=True)
class PlanForces:
    """Worst forces of the three actuators along a plan."""

    rho1: WorstForce
    rho2: WorstForce
    rho3: WorstForce

    @property
    def worst(self) -> WorstForce:
        """Of the actuator that comes nearest to its limit."""
        return max((self.rho1, self.rho2, self.rho3), key=lambda found: found.utilisation)

    @property
    def within_limits(self) -> bool:
        """No actuator is asked for more than it can give."""
        return self.worst.margin_n >= 0


def forces_along(
    geometry: RobotGeometry,
    plan: MotionPlan,
    case: LoadCase = LoadCase.HOLDING,
    *,
    loads: Loads = DEFAULT_LOADS,
    limits: ActuatorLimits = DEFAULT_LIMITS,
    period_s: float = 0.01,
) -> PlanForces:
    """Worst static force of each actuator while a plan runs.

    Args:
        geometry: The robot.
        plan: The motion; looked at every period_s and at both ends.
        case: What the plug does during the whole plan.
        loads: Masses and forces.
        limits: What the actuators can hold.
        period_s: Between two looks; at 80 mm/s and 0.01 s the legs move by less than 1 mm.

    Raises:
        LegsCannotCloseError: the plan passes a pose that does not exist or holds no force.
    """
    times_s = np.linspace(0.0, plan.duration_s, math.ceil(plan.duration_s / period_s) + 1)
    joints_mm = plan.sample(times_s).position_mm
    forces_n = actuator_loads_many(geometry, joints_mm, loads, case)
    lost = np.isnan(forces_n).any(axis=-1)
    if lost.any():
        first = int(np.argmax(lost))
        at = f"{times_s[first]:.2f} s after its start the plan leaves the poses of the robot"
        raise LegsCannotCloseError(at, {"time_s": float(times_s[first])})
    found = []
    for column, (joint, limit_n) in enumerate(zip(gamma.JOINT_NAMES, limits.joints, strict=True)):
        row = int(np.argmax(np.abs(forces_n[:, column])))
        where = JointPosition(*joints_mm[row].tolist())
        found.append(
            WorstForce(joint, float(forces_n[row, column]), limit_n, float(times_s[row]), where)
        )
    return PlanForces(*found)
