"""Which ends of a plug's motion mean that it met resistance."""

from __future__ import annotations

from drivers.robot import FaultCode
from server.control.errors import (
    ControlError,
    FollowingError,
    ForceLimitError,
    RobotFaultError,
    SlideStalledError,
)

HARD = 0.5
"""A slide that stands still against less than this share of its force limit has another trouble."""


def is_resistance(error: ControlError, limit_n: float) -> bool:
    """Whether something held the plug; any other fault is for a person to look at.

    Args:
        error: What ended the motion.
        limit_n: The force that was allowed.
    """
    if isinstance(error, SlideStalledError | FollowingError):
        return abs(float(error.context["force_n"])) >= HARD * limit_n
    if isinstance(error, RobotFaultError):
        return error.context.get("fault") == FaultCode.STALL.value
    return isinstance(error, ForceLimitError)
