"""What to do with a calibration, of whatever it is."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum


class Grade(StrEnum):
    """What to do with a calibration; from best to worst."""

    GOOD = "good"
    USABLE = "usable"
    BAD = "bad"


def worst(grades: Iterable[Grade]) -> Grade:
    """The worst of several, good if there is none."""
    return max(grades, key=list(Grade).index, default=Grade.GOOD)
