"""What goes over the link to a motion board, for a person who wants to see it.

Optional: a driver that can tell has an attribute ``traffic``. Nothing is put into words before
somebody listens.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable


@dataclass(frozen=True, slots=True)
class Passage:
    """One message on its way.

    Attributes:
        at_s: When the host sent or received it, event loop time.
        to_board: Sent by the host; otherwise by the board.
        kind: Name of the message.
        words: Its contents.
        size_bytes: On the wire, delimiter included; None where there is no wire.
        error: It tells of something that went wrong.
    """

    at_s: float
    to_board: bool
    kind: str
    words: str
    size_bytes: int | None = None
    error: bool = False


OnPassage = Callable[[Passage], None]


class Traffic:
    """Hands passages to whoever listens."""

    def __init__(self) -> None:
        self._listeners: list[OnPassage] = []

    @property
    def heard(self) -> bool:
        """Whether somebody listens; nobody else needs words."""
        return bool(self._listeners)

    def listen(self, listener: OnPassage) -> None:
        """Call ``listener`` with every passage from now on."""
        self._listeners.append(listener)

    def forget(self, listener: OnPassage) -> None:
        """Call it no more."""
        self._listeners.remove(listener)

    def tell(self, passage: Passage) -> None:
        """Something went over the link."""
        for listener in self._listeners:
            listener(passage)


@runtime_checkable
class TellsTraffic(Protocol):
    """A driver that can tell what goes over its link."""

    traffic: Traffic
