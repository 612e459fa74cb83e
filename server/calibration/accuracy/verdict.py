"""Is the robot exact enough for sockets?"""

from __future__ import annotations

from collections.abc import Sequence

from server.calibration.grade import Grade
from server.schema.accuracy import CheckedPlace

REQUIRED_MM = 0.5
"""Location accuracy that the robot's design asks for (0.5 +-0.1 mm)."""
USABLE_MM = 1.0
"""So much the camera still takes out on the last bit of the way."""
MOST_PLAY_MM = 0.3


def judge_places(places: Sequence[CheckedPlace]) -> tuple[Grade, tuple[str, ...]]:
    """Grade and remarks of a nine-point check, by its worst place.

    Args:
        places: One or more.
    """
    off_mm = max(place.accuracy_mm + place.repeatability_mm for place in places)
    if off_mm <= REQUIRED_MM:
        return Grade.GOOD, ()
    grade = Grade.USABLE if off_mm <= USABLE_MM else Grade.BAD
    remarks = [f"AP + RP is up to {off_mm:.2f} mm; {REQUIRED_MM:g} mm are asked for."]
    if max(place.direction_variation_mm for place in places) > MOST_PLAY_MM:
        remarks.append("Most of it is play: tighten the belts, then check again.")
    elif max(place.accuracy_mm for place in places) > 0.5 * off_mm:
        remarks.append("The places are off, but repeat: measure the robot, then check again.")
    else:
        remarks.append("The places do not repeat: look whether a carriage sticks.")
    return grade, tuple(remarks)
