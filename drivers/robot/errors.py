"""Errors of robot drivers.

RobotDriverError
├── NotConnectedError   there is no live link to the board
├── QueueFullError      the segments do not fit into the board's queue
└── BoardRefusedError   the board refused a command and said why
"""

from __future__ import annotations

import re
from typing import ClassVar

_BETWEEN_WORDS = re.compile(r"(?<=[a-z])(?=[A-Z])")


class RobotDriverError(Exception):
    """Something went wrong between the host and the motion board.

    Attributes:
        code: Stable name of what it was: that of the type, such as not_connected.
    """

    code: ClassVar[str] = "robot_driver"

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.code = _BETWEEN_WORDS.sub("_", cls.__name__.removesuffix("Error")).lower()


class NotConnectedError(RobotDriverError):
    """There is no live link to the board."""


class QueueFullError(RobotDriverError):
    """More segments were pushed than the board's queue has room for; none was taken."""


class BoardRefusedError(RobotDriverError):
    """The board refused a command in its present state; the message says which and why."""
