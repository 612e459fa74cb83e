"""Where the joints should be, and what shows when they are not."""

from __future__ import annotations

import pytest

from tests.support.slide_drive import MASSES_N_S2_MM
from tests.twin.divergence.samples import START, real_drive, sample, slide_in
from twin.divergence import Quantity
from twin.divergence.numbers import TrackingNumbers
from twin.divergence.tracking import FirstOrderLag, Tracking
from twin.joints import JointVelocity

NUMBERS = TrackingNumbers()


def worst(samples: object, quantity: Quantity) -> float:
    tracking = Tracking(NUMBERS)
    return max(
        residual.sigmas
        for each in samples  # type: ignore[attr-defined]  # any iterable of samples
        for residual in tracking.compare(each)
        if residual.quantity is quantity
    )


def test_the_lag_agrees_with_a_fine_integration() -> None:
    lag = FirstOrderLag(NUMBERS.slide_lag_s)
    differences = [
        lag.follow(
            each.at_s, each.commanded.rho3_mm, each.velocity.rho3_mm_s, each.measured.rho3_mm
        )
        - each.measured.rho3_mm
        for each in slide_in()
    ]
    assert max(map(abs, differences)) < 2e-3


def test_a_good_slide_stays_within_one_sigma() -> None:
    assert worst(slide_in(), Quantity.RHO3) < 1.0


@pytest.mark.parametrize("mass_n_s2_mm", MASSES_N_S2_MM)
def test_a_drive_that_follows_better_than_usual_is_good(mass_n_s2_mm: float) -> None:
    assert worst(real_drive(lambda _: 1.5, mass_n_s2_mm), Quantity.RHO3) < 4.0


@pytest.mark.parametrize("lag_s", [0.045, 0.06, 0.1])
def test_a_slow_slide_shows(lag_s: float) -> None:
    assert worst(slide_in(lag_s=lag_s), Quantity.RHO3) > 4.0


def test_a_stuck_slide_shows_within_a_tenth_of_a_second() -> None:
    tracking = Tracking(NUMBERS)
    stuck_at_s = None
    for each in slide_in(stuck_at_mm=80.0):
        if stuck_at_s is None and each.measured.rho3_mm >= 80.0:
            stuck_at_s = each.at_s
        slide = tracking.compare(each)[2]
        if slide.sigmas > 4:
            assert stuck_at_s is not None
            assert each.at_s - stuck_at_s < 0.1
            return
    pytest.fail("it did not show")


def test_a_carriage_that_counts_other_steps_shows() -> None:
    moving = JointVelocity(60.0, -60.0, 0.0)
    off = sample(measured=START._replace(rho2_mm=START.rho2_mm + 0.5), velocity=moving)
    left, right, _ = Tracking(NUMBERS).compare(off)
    assert left.sigmas == 0
    assert right.sigmas > 5
    assert right.difference == pytest.approx(0.5)


def test_after_a_gap_the_robot_is_believed() -> None:
    lag = FirstOrderLag(0.02)
    assert lag.follow(0.0, 60.0, 0.0, 60.3) == 60.0
    assert lag.follow(5.0, 70.0, 10.0, 69.5) == 69.5


def test_under_load_the_slide_may_give_way() -> None:
    free, loaded = sample(), sample(force_n=70.0)
    tracking = Tracking(NUMBERS.model_copy(update={"slide_give_mm_n": 0.002}))
    assert tracking.compare(loaded)[2].sigma > 2 * tracking.compare(free)[2].sigma
