"""Errors of charging stations. Every message says what a person can do.

StationError
├── StationUnsupportedError   this kind of station cannot do that
├── StationNotOpenError       the driver is closed
├── StationUnreachableError   nobody at its address, or the connection broke
├── StationSilentError        it did not answer in time
├── StationLoginError         it does not accept our user or password
├── StationRefusedError       it understood, and said no
├── StationAnswerError        it answered something that makes no sense
├── StationStaleError         what it says is too old, or does not change with time
├── StationHeldError          a hold of ours is in force
└── StationMemoryError        what must survive a restart cannot be written or read
"""

from __future__ import annotations


class StationError(Exception):
    """The station did not answer, or answered something that makes no sense."""


class StationUnsupportedError(StationError):
    """This kind of station cannot do that; see its capabilities."""


class StationNotOpenError(StationError):
    """The driver is closed: open it first."""


class StationUnreachableError(StationError):
    """Nobody listens at its address, or the connection broke."""


class StationSilentError(StationError):
    """It did not answer in time."""


class StationLoginError(StationError):
    """It does not accept our user or password."""


class StationRefusedError(StationError):
    """It understood the request and refused it."""


class StationAnswerError(StationError):
    """It answered something that makes no sense; nothing may be concluded from it."""


class StationStaleError(StationError):
    """What it says is too old, or does not change with time; it counts as unknown."""


class StationHeldError(StationError):
    """A hold of ours is in force: release it before the station may give power."""


class StationMemoryError(StationError):
    """What must survive a restart of this process cannot be written or read."""
