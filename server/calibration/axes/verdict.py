"""What figures of one axis are worth, in words that say what to do."""

from __future__ import annotations

from collections.abc import Mapping

from server.calibration.axes.estimates import Estimate
from server.calibration.grade import Grade, worst

GOOD_SWITCH_MM, USABLE_SWITCH_MM = 0.05, 0.2
"""A switch that spreads more shifts each place by more than the camera still takes out on the way
into the socket."""

GOOD_PLAY_MM, USABLE_PLAY_MM = 0.15, 0.4
"""The last bit of every way is taken from the same side, so play alone shifts nothing; a belt that
is loose by more than this gives way when the plug pushes."""

USABLE_FOLLOWING_MM = 1.0

Verdict = tuple[Grade, tuple[str, ...]]


def judge_switches(spread: Mapping[str, Estimate]) -> Verdict:
    """Grade and remarks of the switches, by the name of the carriage."""
    grades, remarks = [], []
    for carriage, found in spread.items():
        grades.append(_grade(found.value, GOOD_SWITCH_MM, USABLE_SWITCH_MM))
        if grades[-1] is not Grade.GOOD:
            remarks.append(
                f"The {carriage} switch closes within {found.value:.2f} mm only: fasten it, and "
                "look for play of its lever. If the car has moved meanwhile, measure again."
            )
    return worst(grades), tuple(remarks)


def judge_play(play: Mapping[str, Estimate], following_mm: Mapping[str, float]) -> Verdict:
    """Grade and remarks of play and following, by the name of the carriage."""
    grades, remarks = [], []
    for carriage, found in play.items():
        grades.append(_grade(abs(found.value), GOOD_PLAY_MM, USABLE_PLAY_MM))
        if grades[-1] is not Grade.GOOD:
            remarks.append(
                f"The {carriage} carriage has {found.value:.2f} mm of play: tighten its belt, and "
                "look at pulley and gear."
            )
    for carriage, furthest_mm in following_mm.items():
        if furthest_mm > USABLE_FOLLOWING_MM:
            grades.append(Grade.BAD)
            remarks.append(f"The {carriage} carriage lags by {furthest_mm:.1f} mm while it moves.")
    return worst(grades), tuple(remarks)


def _grade(value: float, good: float, usable: float) -> Grade:
    if value <= good:
        return Grade.GOOD
    return Grade.USABLE if value <= usable else Grade.BAD
