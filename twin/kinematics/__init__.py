"""Kinematics of the robot, both ways, one pose at a time or many at once.

Scalar functions are plain floats and tuples, for control loops; the ``*_many`` functions are
arrays, for grids and whole motions. `alpha` is the parallel mechanism in the wall plane, `beta`
the insertion slide, `gamma` the assembled robot.
"""

from twin.kinematics import alpha, beta, gamma, singularity
from twin.kinematics.alpha import LegVectors, PlatformPosition
from twin.kinematics.errors import (
    KinematicsError,
    LegsCannotCloseError,
    NearSingularityError,
    UnreachableError,
    UnreachableReason,
)
from twin.kinematics.gamma import (
    check_joint_limits,
    forward,
    forward_many,
    inverse,
    inverse_many,
    inverse_unlimited,
    jacobian,
    platform,
    within_limits_many,
)
from twin.kinematics.singularity import SingularityLimits, SingularityMeasures

__all__ = [
    "KinematicsError",
    "LegVectors",
    "LegsCannotCloseError",
    "NearSingularityError",
    "PlatformPosition",
    "SingularityLimits",
    "SingularityMeasures",
    "UnreachableError",
    "UnreachableReason",
    "alpha",
    "beta",
    "check_joint_limits",
    "forward",
    "forward_many",
    "gamma",
    "inverse",
    "inverse_many",
    "inverse_unlimited",
    "jacobian",
    "platform",
    "singularity",
    "within_limits_many",
]
