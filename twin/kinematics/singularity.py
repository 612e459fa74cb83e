"""How far a pose is from the singularities of alpha.

With the legs d1, h1, d2, h2 of `twin.kinematics.alpha`:

- parallel: d1 h2 + d2 h1 = 0, the legs are aligned and the platform is free to move;
- serial: d1 = 0 or d2 = 0, a leg stands perpendicular to the rail and its carriage loses its
  effect on the platform;
- parallelogram: A-B-F-D is flat, AB parallel to BF = (L3/2, e_py), and the platform may turn.
  Its area is L |(L3/2) sin(phi) - e_py cos(phi)| with phi = atan2(h1, d1).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha, gamma
from twin.kinematics.alpha import LegVectors
from twin.kinematics.errors import NearSingularityError

Array = NDArray[np.float64]
Ratio = Annotated[float, Field(ge=0, lt=1, allow_inf_nan=False)]


@dataclass(frozen=True, slots=True)
class SingularityMeasures:
    """Distances from the singularities, 0 on them. All but the area are dimensionless, 0 to 1.

    Attributes:
        parallel: (d1 h2 + d2 h1) / L^2, the sine of the angle between the legs.
        serial_left: d1 / L.
        serial_right: d2 / L.
        parallelogram: Sine of the angle between AB and BF.
        parallelogram_area_mm2: Area of A-B-F-D [mm^2], which its stiffness follows.
    """

    parallel: float
    serial_left: float
    serial_right: float
    parallelogram: float
    parallelogram_area_mm2: float


class SingularityLimits(BaseModel):
    """The least measures that a motion may pass through.

    The defaults are this project's own: they keep the legs of the default robot at least 6 deg
    from folded flat and from perpendicular to the rail.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    parallel: Ratio = 0.2
    serial: Ratio = 0.1
    parallelogram: Ratio = 0.2


MEASURE_NAMES = ("parallel", "serial_left", "serial_right", "parallelogram")


def measures_of_legs(geometry: RobotGeometry, legs: LegVectors) -> SingularityMeasures:
    """Measures of a pose given by its legs."""
    d1, h1, d2, h2 = legs
    length = geometry.leg_length_mm
    half_mm = 0.5 * geometry.platform_width_mm
    # L sin(phi) = h1 and L cos(phi) = d1
    area = abs(half_mm * h1 - geometry.e_py_mm * d1)
    return SingularityMeasures(
        parallel=(d1 * h2 + d2 * h1) / (length * length),
        serial_left=d1 / length,
        serial_right=d2 / length,
        parallelogram=area / (length * math.hypot(half_mm, geometry.e_py_mm)),
        parallelogram_area_mm2=area,
    )


def measures(geometry: RobotGeometry, joints: JointPosition) -> SingularityMeasures:
    """Measures of the pose at given joint positions.

    Raises:
        LegsCannotCloseError: no pose of the assembled robot has these joints.
    """
    v = gamma.platform(geometry, joints)
    return measures_of_legs(
        geometry, alpha.leg_vectors(geometry, v, joints.rho1_mm, joints.rho2_mm)
    )


def check(
    geometry: RobotGeometry, joints: JointPosition, limits: SingularityLimits
) -> SingularityMeasures:
    """Measures of the pose, if all of them are large enough.

    Raises:
        NearSingularityError: one of them is too small.
        LegsCannotCloseError: no pose of the assembled robot has these joints.
    """
    found = measures(geometry, joints)
    for name, minimum in zip(MEASURE_NAMES, thresholds(limits), strict=True):
        value = getattr(found, name)
        if value < minimum:
            msg = (
                f"{_SENTENCES[name]}: the {name} measure is {value:.3f} and must be "
                f"at least {minimum:g}"
            )
            raise NearSingularityError(msg, measure=name, value=value, minimum=minimum)
    return found


def thresholds(limits: SingularityLimits) -> tuple[float, float, float, float]:
    """The limits in the order of MEASURE_NAMES."""
    return (limits.parallel, limits.serial, limits.serial, limits.parallelogram)


def measures_many(geometry: RobotGeometry, joints_mm: Array) -> Array:
    """Measures of many poses.

    Args:
        geometry: The robot.
        joints_mm: Joint positions, shape (..., 3) or only (rho1, rho2), shape (..., 2) [mm].

    Returns:
        The measures in the order of MEASURE_NAMES, shape (..., 4); NaN where no pose exists.
    """
    rho = joints_mm[..., :2]
    v = alpha.forward_many(geometry, rho)
    half_mm = 0.5 * geometry.platform_width_mm
    length = geometry.leg_length_mm
    d1 = v[..., 0] - geometry.e1x_mm - half_mm - rho[..., 0]
    d2 = geometry.base_width_mm - v[..., 0] - half_mm - geometry.e2x_mm - rho[..., 1]
    h1, h2 = v[..., 1] - geometry.e1y_mm, v[..., 1] - geometry.e2y_mm
    area = np.abs(half_mm * h1 - geometry.e_py_mm * d1)
    return np.stack(
        (
            (d1 * h2 + d2 * h1) / length**2,
            d1 / length,
            d2 / length,
            area / (length * math.hypot(half_mm, geometry.e_py_mm)),
        ),
        axis=-1,
    )


_SENTENCES = {
    "parallel": "the two legs are nearly in line",
    "serial_left": "the left leg stands nearly perpendicular to the rail",
    "serial_right": "the right leg stands nearly perpendicular to the rail",
    "parallelogram": "the parallelogram of the left leg is nearly flat",
}
