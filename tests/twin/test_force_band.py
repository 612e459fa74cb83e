from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twin.force_band import ForceBand, learn_band

BAND = ForceBand([(0.0, -10.0, 30.0), (20.0, 0.0, 50.0), (40.0, 10.0, 80.0)])


def test_it_is_linear_between_its_points_and_constant_outside() -> None:
    assert BAND.at(-5.0) == (-10.0, 30.0)
    assert BAND.at(10.0) == pytest.approx((-5.0, 40.0))
    assert BAND.at(20.0) == (0.0, 50.0)
    assert BAND.at(30.0) == pytest.approx((5.0, 65.0))
    assert BAND.at(99.0) == (10.0, 80.0)


@given(st.floats(-50, 100))
def test_its_lower_edge_stays_below_its_upper_one(depth_mm: float) -> None:
    lower_n, upper_n = BAND.at(depth_mm)
    assert lower_n < upper_n


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([], "at least one"),
        ([(0.0, 0.0, 1.0), (0.0, 0.0, 1.0)], "ascend"),
        ([(0.0, 2.0, 1.0)], "below"),
    ],
)
def test_what_is_no_band(points: list[tuple[float, float, float]], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        ForceBand(points)


def insertion(peak_n: float, noise_n: float = 0.0) -> list[tuple[float, float]]:
    """Rises to its peak at 36 mm, then falls."""
    depths = [0.5 * i for i in range(81)]
    return [
        (
            d,
            peak_n * (min(d, 36.0) / 36.0) ** 2 * (1.0 if d < 38 else 0.6)
            + noise_n * math.sin(9 * d),
        )
        for d in depths
    ]


def test_a_learnt_band_holds_good_insertions_and_neither_a_jam_nor_a_miss() -> None:
    peaks = (66.0, 68.0, 70.0, 72.0, 74.0)
    band = learn_band([insertion(p, 0.8) for p in peaks], [4.0 * i for i in range(11)])
    for peak_n in (65.0, 75.0):
        for depth_mm, force_n in insertion(peak_n, 0.8):
            if depth_mm < 36.0:
                lower_n, upper_n = band.at(depth_mm)
                assert lower_n < force_n < upper_n
    assert band.at(36.0)[1] < 120.0
    assert band.at(36.0)[0] > 20.0
    assert band.at(8.0)[1] < 15.0, "where little is usual, little is allowed"


def test_the_more_insertions_differ_the_wider_the_band() -> None:
    depths = [10.0, 20.0, 30.0]
    narrow = learn_band([insertion(p) for p in (69.0, 70.0, 71.0)], depths)
    wide = learn_band([insertion(p) for p in (60.0, 70.0, 80.0)], depths)
    assert wide.at(30.0)[1] > narrow.at(30.0)[1] + 10.0
    assert wide.at(30.0)[0] < narrow.at(30.0)[0] - 10.0
    assert learn_band([insertion(70.0)] * 3, depths, limit_n=40.0).at(30.0)[1] == 40.0


def test_too_little_to_learn_from() -> None:
    with pytest.raises(ValueError, match="three"):
        learn_band([insertion(70.0)] * 2, [10.0])
    with pytest.raises(ValueError, match="in common"):
        learn_band([insertion(70.0)] * 3, [80.0])
