"""Looking at a whole plan before its first step."""

from __future__ import annotations

import math

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma, singularity
from twin.kinematics.errors import KinematicsError
from twin.kinematics.singularity import SingularityLimits
from twin.motion.errors import UnsafePlanError
from twin.motion.plan import MotionPlan

LIMIT_TOLERANCE_MM = 1e-3
"""Beyond a joint limit by less than this is on it: far below what any joint resolves."""

DEFAULT_SINGULARITY_LIMITS = SingularityLimits()


def check_plan(
    geometry: RobotGeometry,
    plan: MotionPlan,
    *,
    period_s: float = 0.01,
    singularity_limits: SingularityLimits = DEFAULT_SINGULARITY_LIMITS,
) -> None:
    """Do nothing if a plan is safe along its whole length.

    Joint limits, the workspace and the singularities are looked at every period_s and at both
    ends. Between two looks a joint that turns round can go further by at most
    acceleration period^2 / 8, which is 0.005 mm at 400 mm/s^2 and 0.01 s.

    Raises:
        UnsafePlanError: with the first time and place where something is wrong.
    """
    times_s = np.linspace(0.0, plan.duration_s, math.ceil(plan.duration_s / period_s) + 1)
    joints_mm = plan.sample(times_s).position_mm
    within = gamma.within_limits_many(geometry, joints_mm, tolerance_mm=LIMIT_TOLERANCE_MM)
    measures = singularity.measures_many(geometry, joints_mm)
    # NaN, where no pose exists, compares false
    regular = np.all(measures >= singularity.thresholds(singularity_limits), axis=-1)
    unsafe = ~(within & regular)
    if not unsafe.any():
        return
    first = int(np.argmax(unsafe))
    joints = JointPosition(*joints_mm[first].tolist())
    try:
        gamma.check_joint_limits(geometry, joints, tolerance_mm=LIMIT_TOLERANCE_MM)
        singularity.check(geometry, joints, singularity_limits)
    except KinematicsError as cause:
        raise UnsafePlanError(float(times_s[first]), joints, cause) from cause
    msg = f"the scalar and the vectorised kinematics disagree at {joints}"
    raise AssertionError(msg)
