"""Robots: the protocol every motion board driver follows, and what such a board reports."""

from drivers.robot.errors import (
    BoardRefusedError,
    NotConnectedError,
    QueueFullError,
    RobotDriverError,
)
from drivers.robot.protocol import RobotDriver, RobotIdentity, StopCategory
from drivers.robot.state import (
    SEGMENT_NUMBERS,
    BoardFault,
    BoardState,
    CommandedJoints,
    FaultCode,
    LimitSwitches,
    MeasuredJoints,
    RobotState,
)

__all__ = [
    "SEGMENT_NUMBERS",
    "BoardFault",
    "BoardRefusedError",
    "BoardState",
    "CommandedJoints",
    "FaultCode",
    "LimitSwitches",
    "MeasuredJoints",
    "NotConnectedError",
    "QueueFullError",
    "RobotDriver",
    "RobotDriverError",
    "RobotIdentity",
    "RobotState",
    "StopCategory",
]
