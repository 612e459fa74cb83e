from __future__ import annotations

import pytest

from server.control.force_curve import ForceCurve


def curve_of(points: list[tuple[float, float]]) -> ForceCurve:
    curve = ForceCurve()
    for depth_mm, force_n in points:
        curve.add(depth_mm, force_n)
    return curve


def test_two_noisy_samples_of_five_mean_nothing() -> None:
    curve = curve_of([(0.1 * i, 200.0 if i % 5 in {1, 3} else 10.0) for i in range(40)])
    assert curve.largest_push_n == 10.0
    assert curve.largest_pull_n == 0.0


def test_a_pull_is_negative() -> None:
    curve = curve_of([(40.0 - i, -30.0) for i in range(10)])
    assert (curve.largest_push_n, curve.largest_pull_n) == (0.0, 30.0)


def test_the_newest_point_lies_in_the_middle_of_its_window() -> None:
    curve = ForceCurve()
    points = [curve.add(float(i), 10.0 * i) for i in range(6)]
    assert points == [None, None, None, None, (2.0, 20.0), (3.0, 30.0)]


def test_a_hard_stop_is_steep_and_rubbing_contacts_are_not() -> None:
    rubbing = [(0.1 * i, 0.6 * i) for i in range(400)]
    assert curve_of(rubbing).final_stiffness_n_mm() == pytest.approx(6.0, rel=0.5)
    # from 42 N at 400 N/mm to 79 N
    seated = [(30 + 0.1 * i, 42.0) for i in range(95)]
    stop = [(39.45 + 0.02 * i, min(42.0 + 8.0 * i, 79.0)) for i in range(10)]
    assert curve_of(seated + stop).final_stiffness_n_mm() > 60.0
    assert curve_of([]).final_stiffness_n_mm() == 0.0
    assert curve_of([(40.0, 79.0)] * 20).final_stiffness_n_mm() == 0.0, "no way, no stiffness"


def test_its_summary_is_short() -> None:
    curve = curve_of([(0.1 * i, 0.2 * i) for i in range(400)])
    summary = curve.summary()
    assert len(summary) == 21
    assert summary[5] == pytest.approx((10.0, 20.0), abs=0.2)
