"""How far a routine is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from server.schema.routines import RoutineLook


@dataclass(slots=True)
class Progress:
    """Filled by a routine, shown by the desk.

    Attributes:
        changed: Called when there is something new.
        doing: In a sentence.
        done: Places that were looked from.
        total: Places to look from; 0 until they are chosen.
        looks: Where, and whether the label was there.
    """

    changed: Callable[[], None]
    doing: str = "Making the robot ready."
    done: int = 0
    total: int = 0
    looks: list[RoutineLook] = field(default_factory=list)

    def say(self, doing: str) -> None:
        """Show what is going on."""
        self.doing = doing
        self.changed()

    def looked(self, x_mm: float, y_mm: float, *, seen: bool) -> None:
        """A place is done."""
        self.looks.append(RoutineLook(x_mm=round(x_mm, 1), y_mm=round(y_mm, 1), seen=seen))
        self.done += 1
        self.changed()
