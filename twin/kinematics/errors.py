"""Errors of the kinematics.

KinematicsError
├── UnreachableError       no joint positions within the limits put the tip there
├── LegsCannotCloseError   no platform position belongs to these joint positions
└── NearSingularityError   the pose is too near a singularity
"""

from __future__ import annotations

from enum import StrEnum
from typing import ClassVar

from twin.errors import TwinError


class UnreachableReason(StrEnum):
    """Why a position cannot be reached."""

    LEGS_TOO_SHORT = "legs_too_short"
    WRONG_SIDE = "wrong_side"
    BELOW_JOINT_LIMIT = "below_joint_limit"
    ABOVE_JOINT_LIMIT = "above_joint_limit"
    NOT_FINITE = "not_finite"


class KinematicsError(TwinError):
    """A pose that the robot cannot or must not take."""

    code: ClassVar[str] = "kinematics"


class UnreachableError(KinematicsError):
    """No joint positions within the limits put the robot there.

    Attributes:
        reason: Which condition fails; with several joint limits the one exceeded most.
        joint: Joint whose limit is exceeded ("rho1", "rho2", "rho3"), None for the legs.
        limit_mm: That limit, None for the legs.
        excess_mm: By how much, always positive: distance beyond the limit, or length that the
            legs lack, or distance to the far side of the carriages.
    """

    code: ClassVar[str] = "unreachable"
    remedy: ClassVar[str] = "Park the car so that its socket is within the robot's reach."

    def __init__(
        self,
        message: str,
        *,
        reason: UnreachableReason,
        excess_mm: float,
        joint: str | None = None,
        limit_mm: float | None = None,
    ) -> None:
        super().__init__(
            message,
            {
                "reason": reason.value,
                "joint": joint,
                "limit_mm": limit_mm,
                "excess_mm": excess_mm,
            },
        )
        self.reason = reason
        self.joint = joint
        self.limit_mm = limit_mm
        self.excess_mm = excess_mm


class LegsCannotCloseError(KinematicsError):
    """These joint positions belong to no pose of the assembled robot."""

    code: ClassVar[str] = "legs_cannot_close"
    remedy: ClassVar[str] = "The measured joint positions cannot be right: home the robot."


class NearSingularityError(KinematicsError):
    """The pose is too near a singularity to hold or to command.

    Attributes:
        measure: Which measure is too small, a field of SingularityMeasures.
        value: That measure, dimensionless.
        minimum: The least value allowed.
    """

    code: ClassVar[str] = "near_singularity"
    remedy: ClassVar[str] = "Choose a target nearer the middle of the workspace."

    def __init__(self, message: str, *, measure: str, value: float, minimum: float) -> None:
        super().__init__(message, {"measure": measure, "value": value, "minimum": minimum})
        self.measure = measure
        self.value = value
        self.minimum = minimum
