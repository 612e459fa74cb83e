"""Errors of the link to the real board.

NotConnectedError
├── BoardNotFoundError   there is no port that could be the board's, or it cannot be opened
├── BoardSilentError     the port is open, but nothing that speaks the protocol answers
├── WrongFirmwareError   the board speaks another version of the protocol
└── LinkLostError        the link broke while it was in use
"""

from __future__ import annotations

from drivers.robot import NotConnectedError


class BoardNotFoundError(NotConnectedError):
    """There is no port that could be the board's, or it cannot be opened."""


class BoardSilentError(NotConnectedError):
    """Nothing on the port answers in the board's language."""


class WrongFirmwareError(NotConnectedError):
    """The board speaks another version of the protocol; it needs the firmware of this version."""


class LinkLostError(NotConnectedError):
    """The link broke while it was in use."""
