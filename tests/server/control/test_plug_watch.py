"""What a motion of the plug may feel like at each depth, and how the slide must follow."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import pytest

from drivers.robot import RobotState
from server.config.insertion import InsertionSettings
from server.config.supervision import SupervisionSettings
from server.control.errors import (
    ControlError,
    FollowingError,
    ForceAboveBandError,
    ForceBelowBandError,
    ForceLimitError,
    SlideStalledError,
)
from server.control.plug_watch import PlugWatch
from tests.support.robot_cell import RobotCell, in_cell
from twin.force_band import ForceBand

FACE_MM = 70.0
PERIOD_S = 0.01
SPEED_MM_S = 12.0
INSERTION = InsertionSettings()


async def _state(cell: RobotCell) -> RobotState:
    return cell.robot


STATE = in_cell(_state)


def watch(*, out: bool = False, known: bool = True) -> PlugWatch:
    return PlugWatch(
        SupervisionSettings(),
        limit_n=80.0,
        face_rho3_mm=FACE_MM if known else None,
        band=ForceBand(INSERTION.withdrawal_band if out else INSERTION.band),
    )


def sample(
    depth_mm: float, force_n: float, at_s: float, *, out: bool = False, lag_mm: float = 0.2
) -> RobotState:
    sign = -1.0 if out else 1.0
    rho3_mm = FACE_MM + depth_mm
    measured, commanded = STATE.measured, STATE.commanded
    return replace(
        STATE,
        sampled_at_s=at_s,
        force_n=force_n,
        measured=replace(measured, position=measured.position._replace(rho3_mm=rho3_mm)),
        commanded=replace(
            commanded,
            position=commanded.position._replace(rho3_mm=rho3_mm + sign * lag_mm),
            velocity=commanded.velocity._replace(rho3_mm_s=sign * SPEED_MM_S),
        ),
    )


def way(forces: Iterable[tuple[float, float]], *, out: bool = False) -> list[RobotState]:
    """A steady motion through (depth, force)."""
    return [
        sample(depth_mm, force_n, i * PERIOD_S, out=out)
        for i, (depth_mm, force_n) in enumerate(forces)
    ]


def steps(start_mm: float, end_mm: float) -> list[float]:
    step_mm = SPEED_MM_S * PERIOD_S
    count = int(abs(end_mm - start_mm) / step_mm)
    sign = 1 if end_mm > start_mm else -1
    return [start_mm + sign * step_mm * i for i in range(count + 1)]


def good_force_n(depth_mm: float) -> float:
    if depth_mm < 18:
        return 5.0
    return 5.0 + 65.0 * min((depth_mm - 18) / 18, 1.0) if depth_mm < 38 else 45.0


def check_all(samples: Iterable[RobotState], judge: PlugWatch) -> None:
    for state in samples:
        judge.check(state)


def refused(samples: Iterable[RobotState], judge: PlugWatch) -> ControlError:
    with pytest.raises(ControlError) as raised:
        check_all(samples, judge)
    return raised.value


def test_a_good_insertion_passes_and_is_remembered() -> None:
    judge = watch()
    check_all(way((d, good_force_n(d)) for d in steps(-20.0, 40.0)), judge)
    assert judge.curve.largest_push_n == pytest.approx(70.0, abs=1.0)


def test_little_force_is_too_much_at_the_mouth() -> None:
    error = refused(way((d, 35.0 if d > 1 else 0.0) for d in steps(-5.0, 40.0)), watch())
    assert type(error) is ForceAboveBandError
    assert error.context["depth_mm"] == pytest.approx(1.2, abs=0.3)
    assert error.context["force_n"] == 35.0
    assert error.context["limit_n"] == pytest.approx(32.5, abs=1.0)


def test_the_same_force_is_good_deep_in_the_socket_and_no_force_is_not() -> None:
    error = refused(way((d, 2.0) for d in steps(-5.0, 40.0)), watch())
    assert type(error) is ForceBelowBandError
    assert 31.0 < error.context["depth_mm"] < 34.0


def test_before_the_face_only_the_limit_counts() -> None:
    check_all(way((d, 60.0) for d in steps(-20.0, -1.0)), watch())
    error = refused(way((d, 90.0) for d in steps(-20.0, -1.0)), watch())
    assert type(error) is ForceLimitError
    assert error.context["limit_n"] == 80.0


def test_without_a_known_depth_only_the_limit_counts() -> None:
    check_all(way((d, 60.0) for d in steps(0.0, 30.0)), watch(known=False))
    error = refused(way((d, -81.0) for d in steps(0.0, 30.0)), watch(known=False))
    assert "Pulling" in error.detail
    assert "depth_mm" not in error.context


def test_pulling_hard_is_good_deep_in_the_socket_only() -> None:
    good = [(d, -66.0 if d > 34 else -45.0 if d > 26 else -6.0) for d in steps(40.0, -20.0)]
    check_all(way(good, out=True), watch(out=True))
    hooked = [(d, -66.0 if d > 34 else -45.0) for d in steps(40.0, -20.0)]
    error = refused(way(hooked, out=True), watch(out=True))
    assert type(error) is ForceAboveBandError
    assert 15.0 < error.context["depth_mm"] < 22.0


def test_a_plug_that_comes_out_easily_is_no_fault() -> None:
    check_all(way(((d, 0.0) for d in steps(40.0, -20.0)), out=True), watch(out=True))


@pytest.mark.parametrize("force_n", [70.0, 3.0])
def test_a_slide_that_is_told_to_move_and_does_not_has_stalled(force_n: float) -> None:
    judge = watch()
    moving = way((d, 20.0) for d in steps(20.0, 25.0))
    check_all(moving, judge)
    began_s = moving[-1].sampled_at_s
    stuck = [
        sample(25.0, force_n, began_s + i * PERIOD_S, lag_mm=0.2 + 0.12 * i) for i in range(1, 30)
    ]
    error = refused(stuck, judge)
    assert type(error) is SlideStalledError
    assert error.context["force_n"] == force_n


def test_a_slide_at_rest_has_not_stalled() -> None:
    resting = sample(25.0, 20.0, 0.0, lag_mm=0.0)
    check_all([replace(resting, sampled_at_s=0.1 * i) for i in range(50)], watch())


def test_a_slide_that_is_elsewhere_does_not_follow() -> None:
    lagging = [sample(d, 5.0, i * PERIOD_S, lag_mm=2.5) for i, d in enumerate(steps(0.0, 2.0))]
    error = refused(lagging, watch())
    assert type(error) is FollowingError
    assert error.context["lag_mm"] == 2.5
