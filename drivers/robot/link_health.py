"""How well the link to a motion board does, for a person who looks for the cause of a trouble.

Optional: a driver that can tell has a method ``link_health``. What it cannot know is None, never a
guess.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Protocol, Self, runtime_checkable


@dataclass(frozen=True, slots=True)
class RoundTrip:
    """How long the board took to answer the newest questions.

    Attributes:
        newest_s: The last answer.
        median_s: Middle of those that are kept.
        worst_s: The slowest of them.
        answers: How many are kept.
    """

    newest_s: float
    median_s: float
    worst_s: float
    answers: int

    @classmethod
    def of(cls, took_s: Sequence[float]) -> Self | None:
        """From what each answer took, oldest first; None without any."""
        if not took_s:
            return None
        return cls(took_s[-1], median(took_s), max(took_s), len(took_s))


@dataclass(frozen=True, slots=True)
class LinkHealth:
    """The link now. Counters begin at zero whenever the link is opened.

    Attributes:
        reconnections: How often the link was opened anew since the driver was made.
        round_trip: Times of the newest answers.
        received: Intact frames of the board.
        damaged: Frames of the board that arrived damaged.
        damaged_at_board: Frames of the host that the board says arrived damaged.
        sent_again: Messages sent more than once because nobody acknowledged them in time.
        supply_v: Supply voltage of the board.
        temperature_degc: On the board.
    """

    reconnections: int | None = None
    round_trip: RoundTrip | None = None
    received: int | None = None
    damaged: int | None = None
    damaged_at_board: int | None = None
    sent_again: int | None = None
    supply_v: float | None = None
    temperature_degc: float | None = None


@runtime_checkable
class TellsLinkHealth(Protocol):
    """A driver that can tell how its link does."""

    def link_health(self) -> LinkHealth:
        """The link now; without one only how often it was opened anew is known."""
        ...
