"""What the figures of the slide are worth, in words that say what to do."""

from __future__ import annotations

from server.calibration.axes.estimates import Estimate
from server.calibration.grade import Grade, worst

GOOD_FRICTION_N, USABLE_FRICTION_N = 5.0, 12.0
GOOD_OFFSET_N, USABLE_OFFSET_N = 2.0, 5.0
GOOD_SCALE, USABLE_SCALE = 0.05, 0.15
"""How far from 1. The bands of the insertion leave some 10 % of room below the force limit."""
SURELY = 2.0


def judge_force(
    friction: Estimate, offset: Estimate, scale: Estimate | None
) -> tuple[Grade, tuple[str, ...]]:
    """Grade and remarks."""
    grades, remarks = [], []
    grades.append(_grade(abs(friction.value), GOOD_FRICTION_N, USABLE_FRICTION_N))
    if grades[-1] is not Grade.GOOD:
        remarks.append(
            f"The slide takes {friction.value:.1f} N to move freely: clean and grease its screw."
        )
    grades.append(_grade(abs(offset.value), GOOD_OFFSET_N, USABLE_OFFSET_N))
    if grades[-1] is not Grade.GOOD:
        remarks.append(
            f"Without any force the motor current shows {offset.value:.1f} N: something pulls at "
            "the slide, such as the cable."
        )
    if scale is not None:
        off = max(abs(scale.value - 1.0) - SURELY * scale.sigma, 0.0)
        grades.append(_grade(off, GOOD_SCALE, USABLE_SCALE))
        if grades[-1] is not Grade.GOOD:
            remarks.append(
                f"The shown force is {scale.value:.2f} times the true one: put this in force, or "
                "correct the motor's force for its current in the board's settings and repeat."
            )
    return worst(grades), tuple(remarks)


def _grade(value: float, good: float, usable: float) -> Grade:
    if value <= good:
        return Grade.GOOD
    return Grade.USABLE if value <= usable else Grade.BAD
