"""Errors of robot drivers.

RobotDriverError
├── NotConnectedError   there is no live link to the board
├── QueueFullError      the segments do not fit into the board's queue
└── BoardRefusedError   the board refused a command and said why
"""

from __future__ import annotations


class RobotDriverError(Exception):
    """Something went wrong between the host and the motion board."""


class NotConnectedError(RobotDriverError):
    """There is no live link to the board."""


class QueueFullError(RobotDriverError):
    """More segments were pushed than the board's queue has room for; none was taken."""


class BoardRefusedError(RobotDriverError):
    """The board refused a command in its present state; the message says which and why."""
