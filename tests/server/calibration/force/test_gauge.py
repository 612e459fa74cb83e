"""The slide as a force gauge."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from server.calibration.axes.estimates import Estimate
from server.calibration.axes.following import FollowingWatch
from server.calibration.force.gauge import StrokeWatch, friction_and_offset, scale_by_spring
from server.calibration.force.verdict import judge_force
from server.calibration.grade import Grade
from server.control.errors import ControlError
from tests.server.control.test_plug_watch import sample
from tests.support.slide_drive import MASSES_N_S2_MM, driven

RATE = 5.0


def stroke(
    rng: np.random.Generator, *, scale: float, level_n: float, begins_mm: float
) -> NDArray[np.float64]:
    """(rho3, force) against a spring, with friction or offset and noise."""
    way = np.arange(50.0, 58.0, 0.05)
    force = scale * RATE * np.clip(way - begins_mm, 0.0, None) + level_n
    return np.column_stack((way, force + rng.normal(0.0, 0.8, len(way))))


@pytest.mark.parametrize("scale", [0.8, 1.0, 1.15])
def test_a_spring_tells_the_scale_whatever_friction_offset_and_its_place_are(scale: float) -> None:
    rng = np.random.default_rng(1)
    levels = (2.5, -0.5, 2.5, -0.5)
    strokes = [stroke(rng, scale=scale, level_n=n, begins_mm=51.3) for n in levels]
    found = scale_by_spring(strokes, levels, RATE, 0.01)
    assert found.value == pytest.approx(scale, abs=4 * found.sigma)
    assert found.sigma < 0.03


def test_without_a_spring_there_is_no_scale() -> None:
    rng = np.random.default_rng(2)
    falling = stroke(rng, scale=-1.0, level_n=60.0, begins_mm=50.0)
    with pytest.raises(ValueError, match="spring"):
        scale_by_spring([falling], [0.0], RATE, 0.01)


def test_friction_is_half_of_what_differs_and_offset_the_middle() -> None:
    friction, offset = friction_and_offset([2.0, 2.2, 2.1], [-1.0, -0.9, -1.1])
    assert friction.value == pytest.approx(1.55)
    assert offset.value == pytest.approx(0.55)
    assert 0 < friction.sigma < 0.1
    with pytest.raises(ValueError, match="two strokes"):
        friction_and_offset([2.0], [-1.0, -1.1])


def test_the_verdict_names_what_to_mend() -> None:
    fine, sure = Estimate(1.5, 0.1), Estimate(0.0, 0.1)
    assert judge_force(fine, sure, None) == (Grade.GOOD, ())
    assert judge_force(Estimate(8.0, 0.1), sure, None)[0] is Grade.USABLE
    grade, remarks = judge_force(Estimate(15.0, 0.1), Estimate(6.0, 0.1), Estimate(1.3, 0.02))
    assert grade is Grade.BAD
    assert len(remarks) == 3
    # what a spring is not known well enough to say is not said
    assert judge_force(fine, sure, Estimate(1.08, 0.05))[0] is Grade.GOOD


class HitError(ControlError):
    """Something stood in the way."""


@pytest.mark.parametrize("mass_n_s2_mm", MASSES_N_S2_MM)
def test_what_speeds_the_slide_up_is_no_hit_and_a_wall_is_one(mass_n_s2_mm: float) -> None:
    def stroke_to(load_n: Callable[[float], float]) -> None:
        watch = StrokeWatch(20.0, HitError, FollowingWatch())
        for told in driven(load_n, way_mm=12.0, speed_mm_s=7.0, mass_n_s2_mm=mass_n_s2_mm):
            watch.take(
                sample(
                    told.measured_mm,
                    told.force_n,
                    told.at_s,
                    lag_mm=told.set_point_mm - told.measured_mm,
                    speed_mm_s=told.speed_mm_s,
                )
            )

    stroke_to(lambda _: 1.5)
    with pytest.raises(HitError):
        stroke_to(lambda way_mm: max(150.0 * (way_mm - 6.0), 1.5))
