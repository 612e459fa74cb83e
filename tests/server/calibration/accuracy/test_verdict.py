"""What a nine-point check is worth."""

from __future__ import annotations

import pytest

from server.calibration.accuracy.verdict import judge_places
from server.calibration.grade import Grade
from server.schema.accuracy import CheckedPlace


def place(ap_mm: float, rp_mm: float, vap_mm: float = 0.05) -> CheckedPlace:
    return CheckedPlace(
        x_mm=650,
        y_mm=335,
        accuracy_mm=ap_mm,
        repeatability_mm=rp_mm,
        direction_variation_mm=vap_mm,
        attained_mm=[],
    )


@pytest.mark.parametrize(
    ("worst", "grade", "word"),
    [
        (place(0.3, 0.15), Grade.GOOD, ""),
        (place(0.6, 0.1), Grade.USABLE, "measure the robot"),
        (place(0.1, 0.6), Grade.USABLE, "sticks"),
        (place(0.3, 0.6, 0.5), Grade.USABLE, "play"),
        (place(2.0, 0.1), Grade.BAD, "measure the robot"),
    ],
)
def test_the_worst_place_counts_and_says_what_to_mend(
    worst: CheckedPlace, grade: Grade, word: str
) -> None:
    found, remarks = judge_places([place(0.05, 0.05), worst])
    assert found is grade
    assert bool(remarks) is (grade is not Grade.GOOD)
    assert word in " ".join(remarks)
