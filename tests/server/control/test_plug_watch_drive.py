"""The watch over a plug that a real drive moves, whose rotor takes its share of the force."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from drivers.robot import RobotState
from server.control.errors import (
    ControlError,
    ForceAboveBandError,
    ForceBelowBandError,
    ForceLimitError,
)
from server.control.plug_watch import PlugWatch
from tests.server.control.test_plug_watch import good_force_n, refused, sample, watch
from tests.support.slide_drive import MASSES_N_S2_MM, driven

heavy_and_light = pytest.mark.parametrize("mass_n_s2_mm", MASSES_N_S2_MM)

Load = Callable[[float], float]
"""What the plug meets against its motion, at a depth [mm, N]."""


def moved(
    start_mm: float, end_mm: float, load_n: Load, mass_n_s2_mm: float = MASSES_N_S2_MM[0]
) -> Iterator[RobotState]:
    """Telemetry of a motion from rest between two depths."""
    out = end_mm < start_mm
    sign = -1.0 if out else 1.0
    for told in driven(
        lambda way_mm: load_n(start_mm + sign * way_mm),
        way_mm=abs(end_mm - start_mm),
        mass_n_s2_mm=mass_n_s2_mm,
        cap_n=80.0 if out else 79.0,
    ):
        yield sample(
            start_mm + sign * told.measured_mm,
            sign * told.force_n,
            told.at_s,
            out=out,
            lag_mm=told.set_point_mm - told.measured_mm,
            speed_mm_s=told.speed_mm_s,
        )


def noticed(states: Iterator[RobotState], judge: PlugWatch) -> tuple[ControlError, float]:
    """The error that ends a motion, and the depth at which it does."""
    depths: list[float] = []

    def counted() -> Iterator[RobotState]:
        for state in states:
            depths.append(state.measured.position.rho3_mm - 70.0)
            yield state

    return refused(counted(), judge), depths[-1]


@heavy_and_light
@pytest.mark.parametrize(
    ("start_mm", "end_mm", "load_n"),
    [
        pytest.param(11.5, -5.0, lambda _: 6.0, id="out, from where a fault had stopped it"),
        pytest.param(14.0, -5.0, lambda d: 20.0 if d > 0 else 0.0, id="out of a stiff socket"),
        pytest.param(40.0, -5.0, lambda d: 66.0 if d > 36 else 6.0, id="out of the bottom"),
        pytest.param(10.0, 38.0, good_force_n, id="further in"),
        pytest.param(-20.0, 38.0, good_force_n, id="all the way in"),
    ],
)
def test_what_speeds_the_rotor_up_is_no_force_on_the_plug(
    start_mm: float, end_mm: float, load_n: Load, mass_n_s2_mm: float
) -> None:
    judge = watch(out=end_mm < start_mm)
    for state in moved(start_mm, end_mm, load_n, mass_n_s2_mm):
        judge.check(state)


@heavy_and_light
@pytest.mark.parametrize(
    "contact_n",
    [
        pytest.param(lambda d: 45.0 if d > 1 else 0.0, id="rubs"),
        pytest.param(lambda d: max(150.0 * (d - 1.0), 0.0), id="gives like a spring"),
    ],
)
def test_a_bent_contact_is_noticed_within_a_millimetre(
    contact_n: Load, mass_n_s2_mm: float
) -> None:
    error, depth_mm = noticed(moved(-20.0, 38.0, contact_n, mass_n_s2_mm), watch())
    assert type(error) is ForceAboveBandError
    assert 1.0 < depth_mm < 2.0


@heavy_and_light
@pytest.mark.parametrize(
    "hook_n",
    [
        pytest.param(lambda d: 45.0 if d < 16 else 6.0, id="rubs"),
        pytest.param(lambda d: 6.0 + max(150.0 * (16 - d), 0.0), id="gives like a spring"),
    ],
)
def test_a_hook_is_noticed_within_a_millimetre(hook_n: Load, mass_n_s2_mm: float) -> None:
    error, depth_mm = noticed(moved(30.0, -5.0, hook_n, mass_n_s2_mm), watch(out=True))
    assert type(error) is ForceAboveBandError
    assert 15.0 < depth_mm < 16.0


@heavy_and_light
def test_no_socket_is_noticed_as_soon_as_any_would_give_a_force(mass_n_s2_mm: float) -> None:
    error, depth_mm = noticed(moved(-20.0, 38.0, lambda _: 0.0, mass_n_s2_mm), watch())
    assert type(error) is ForceBelowBandError
    assert 30.0 < depth_mm < 33.0


def test_the_limit_counts_whatever_the_rotor_does() -> None:
    speeding_up = list(moved(40.0, 30.0, lambda _: 6.0))[:15]
    too_hard = [replace(state, force_n=-81.0) for state in speeding_up]
    assert type(refused(too_hard, watch(out=True))) is ForceLimitError
