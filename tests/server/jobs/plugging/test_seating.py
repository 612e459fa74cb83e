"""When a plug counts as fully in."""

from __future__ import annotations

import pytest

from server.config.insertion import InsertionSettings
from server.control.errors import ControlError, ForceBelowBandError, ForceLimitError
from server.control.force_curve import ForceCurve
from server.jobs.plugging.pushing import Push
from server.jobs.plugging.seating import is_seated

SETTINGS = InsertionSettings()


def push(
    depth_mm: float, hindrance: ControlError | None = None, *, stiffness_n_mm: float = 400.0
) -> Push:
    """Ends at a depth against a spring that begins a tenth of a millimetre before."""
    curve = ForceCurve()
    for i in range(200):
        at_mm = depth_mm - 0.1 - 0.1 * (199 - i)
        curve.add(at_mm, 42.0)
    for i in range(10):
        at_mm = depth_mm - 0.1 + 0.01 * i
        curve.add(at_mm, min(42.0 + stiffness_n_mm * 0.01 * i, 79.0))
    for _ in range(5):
        curve.add(depth_mm, min(42.0 + stiffness_n_mm * 0.1, 79.0))
    return Push(depth_mm, curve, hindrance)


JAM = ForceLimitError("Pushing took 79 N; the limit is 79 N.")


@pytest.mark.parametrize("depth_mm", [39.05, 40.0, 40.9])
def test_the_depth_alone_is_enough(depth_mm: float) -> None:
    assert is_seated(push(depth_mm), SETTINGS)


@pytest.mark.parametrize("depth_mm", [38.9, 41.1, 10.0])
def test_too_far_away_is_never_seated(depth_mm: float) -> None:
    assert not is_seated(push(depth_mm), SETTINGS)
    assert not is_seated(push(depth_mm, JAM), SETTINGS)


@pytest.mark.parametrize("depth_mm", [39.05, 39.6])
def test_a_hard_stop_within_the_tolerance_is_the_seat(depth_mm: float) -> None:
    assert is_seated(push(depth_mm, JAM), SETTINGS)


def test_a_soft_rise_to_the_limit_is_a_jam_wherever_it_is() -> None:
    assert not is_seated(push(39.6, JAM, stiffness_n_mm=15.0), SETTINGS)


def test_no_force_at_all_is_no_seat() -> None:
    error = ForceBelowBandError("The plug met only 1 N.")
    assert not is_seated(push(39.6, error), SETTINGS)
