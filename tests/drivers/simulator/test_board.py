from __future__ import annotations

import asyncio
import math

import pytest

from drivers.robot import (
    BoardRefusedError,
    BoardState,
    FaultCode,
    QueueFullError,
    RobotState,
    StopCategory,
)
from tests.drivers.simulator.stand import LIMITS, PERFECT, Stand, changed, on_stand
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.segments import Segment

HOME = JointPosition(150.0, 150.0, 50.0)
AWAY = JointPosition(250.0, 170.0, 60.0)
STILL = JointVelocity(0.0, 0.0, 0.0)


def segment(
    start: JointPosition = HOME,
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
    acceleration: tuple[float, float, float] = (100.0, 0.0, 0.0),
    duration_s: float = 0.02,
) -> Segment:
    return Segment(duration_s, start, JointVelocity(*velocity), JointAcceleration(*acceleration))


REFUSED = {
    "jumps": segment(HOME._replace(rho1_mm=150.002)),
    "rho2 jumps by -0.0020": segment(HOME._replace(rho2_mm=149.998)),
    "velocity of rho2 jumps": segment(velocity=(0.0, 0.6, 0.0)),
    "lasts": segment(duration_s=0.021),
    "lasts 0 s": segment(duration_s=0.0),
    "not finite": segment(acceleration=(math.nan, 0.0, 0.0)),
    "beyond its travel": segment(acceleration=(0.0, 0.0, -100.0)),
    "it can do 14": segment(acceleration=(0.0, 0.0, 800.0)),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_a_segment_that_cannot_be_followed_is_refused(reason: str) -> None:
    async def scenario(stand: Stand) -> RobotState:
        with pytest.raises(BoardRefusedError, match=reason):
            await stand.robot.push([REFUSED[reason]])
        await asyncio.sleep(0.5)
        return await stand.state()

    state = on_stand(scenario)
    assert state.board is BoardState.READY
    assert state.commanded.position == HOME
    assert state.queue_free == 16


@pytest.mark.parametrize(
    "accepted",
    [
        segment(HOME._replace(rho1_mm=150.0009)),
        segment(velocity=(0.4, 0.0, 0.0)),
        segment(acceleration=(0.0, 0.0, -40.0)),  # 0.008 mm below the travel
    ],
)
def test_a_segment_within_the_tolerances_is_taken(accepted: Segment) -> None:
    async def scenario(stand: Stand) -> RobotState:
        await stand.robot.push([accepted])
        return await stand.state()

    assert on_stand(scenario).board is not BoardState.READY


def test_of_a_bad_batch_nothing_is_taken() -> None:
    async def scenario(stand: Stand) -> RobotState:
        good = segment()
        with pytest.raises(BoardRefusedError, match="Segment 1"):
            await stand.robot.push([good, good])
        await asyncio.sleep(0.3)
        return await stand.state()

    assert on_stand(scenario).commanded.position == HOME


def test_the_queue_takes_sixteen_segments() -> None:
    async def scenario(stand: Stand) -> None:
        segments = await stand.segments_to(AWAY)
        with pytest.raises(QueueFullError):
            await stand.robot.push(segments[:17])
        await stand.robot.push(segments[:16])
        assert (await stand.state()).queue_free in {0, 1}
        with pytest.raises(QueueFullError):
            await stand.robot.push(segments[16:20])

    on_stand(scenario)


def test_a_streamed_plan_ends_exactly_where_it_should() -> None:
    async def scenario(stand: Stand) -> tuple[RobotState, list[RobotState]]:
        return await stand.move(AWAY), stand.samples

    state, samples = on_stand(scenario)
    assert state.board is BoardState.READY
    assert state.fault is None
    assert state.commanded.position == pytest.approx(AWAY, abs=1e-9)
    assert state.measured.position == pytest.approx(AWAY, abs=0.02)
    assert (
        max(abs(s.measured.velocity.rho1_mm_s) for s in samples) <= LIMITS.rho1.velocity_mm_s + 0.01
    )
    moving = [s for s in samples if s.board is BoardState.RUN]
    worst = max(
        abs(s.measured.position[i] - s.commanded.position[i]) for s in moving for i in (0, 1)
    )
    assert worst <= 0.5 / 226.0


def test_an_empty_queue_brakes_and_latches() -> None:
    async def scenario(stand: Stand) -> RobotState:
        segments = await stand.segments_to(AWAY)
        await stand.robot.push(segments[:16])
        end = segments[15].end
        speed = segments[15].end_velocity.rho1_mm_s
        state = await stand.rest()
        while state.measured.velocity != STILL:
            state = await stand.state()
        braking_mm = speed * speed / (2 * 1500.0)
        assert state.commanded.position.rho1_mm == pytest.approx(end.rho1_mm + braking_mm, abs=0.01)
        return state

    state = on_stand(scenario)
    assert state.fault is not None
    assert state.fault.code is FaultCode.QUEUE_UNDERRUN
    assert state.board is BoardState.FAULT
    assert state.homed
    assert state.enabled


@pytest.mark.parametrize("category", StopCategory)
def test_a_stop_brakes_within_its_distance(category: StopCategory) -> None:
    async def scenario(stand: Stand) -> tuple[RobotState, float, float]:
        segments = await stand.segments_to(AWAY)
        await stand.robot.push(segments[:16])
        await asyncio.sleep(0.2)
        await stand.robot.stop(category)
        await stand.robot.stop(category)  # idempotent
        at_stop = stand.world.line.at(stand.now_s - 0.0045)
        state = await stand.rest()
        travelled = state.commanded.position.rho1_mm - at_stop.position.rho1_mm
        return state, travelled, at_stop.velocity.rho1_mm_s

    state, travelled, speed = on_stand(scenario)
    assert speed > 20.0
    assert travelled == pytest.approx(speed * speed / (2 * 1500.0), rel=0.05)
    assert state.fault is None
    assert state.homed
    holds = category is StopCategory.DECELERATE_AND_HOLD
    assert state.enabled is holds
    assert state.board is (BoardState.READY if holds else BoardState.IDLE)


def test_a_stop_is_honoured_in_every_state() -> None:
    async def scenario(stand: Stand) -> None:
        for category in StopCategory:
            await stand.robot.stop(category)
        assert (await stand.state()).board is BoardState.IDLE
        await stand.robot.emergency_stop()
        await stand.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        assert (await stand.state()).board is BoardState.FAULT

    on_stand(scenario)


def test_after_a_stop_a_new_motion_can_begin() -> None:
    async def scenario(stand: Stand) -> RobotState:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        await asyncio.sleep(0.1)
        await stand.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        await stand.rest()
        return await stand.move(HOME)

    assert on_stand(scenario).commanded.position == pytest.approx(HOME, abs=1e-9)


def test_an_emergency_stop_brakes_releases_and_stays() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        await asyncio.sleep(0.15)
        await stand.robot.emergency_stop()
        state = await stand.rest()
        assert state.fault is not None
        assert state.fault.code is FaultCode.EMERGENCY_STOP
        with pytest.raises(BoardRefusedError, match="still"):
            await stand.robot.clear_fault()
        await asyncio.sleep(0.2)
        state = await stand.state()
        assert not state.enabled
        assert state.force_n == 0.0
        assert 150.5 < state.measured.position.rho1_mm < 165.0
        with pytest.raises(BoardRefusedError, match="emergency_stop"):
            await stand.robot.enable()
        await stand.robot.clear_fault()
        assert (await stand.state()).board is BoardState.IDLE
        await stand.robot.enable()
        state = await stand.move(HOME)
        assert state.commanded.position == pytest.approx(HOME, abs=1e-9)

    on_stand(scenario)


def test_a_limit_switch_stops_at_once_and_takes_the_position_away() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        await asyncio.sleep(0.2)
        stand.robot.trip_limit(1)
        before = await stand.state()
        state = await stand.rest()
        assert state.fault is not None
        assert state.fault.code is FaultCode.LIMIT_SWITCH
        assert "rho2" in state.fault.detail
        assert state.switches.rho2
        assert not state.homed
        assert state.commanded.velocity == STILL
        assert abs(state.commanded.position.rho1_mm - before.commanded.position.rho1_mm) < 1.0
        await asyncio.sleep(0.2)
        # as on the real board: the way out is homing, which leaves the switch by itself
        await stand.robot.clear_fault()
        state = await stand.state()
        assert state.board is BoardState.READY
        assert state.switches.rho2
        stand.robot.mend_limit(1)
        with pytest.raises(BoardRefusedError, match="homing"):
            await stand.robot.push([segment()])

    on_stand(scenario)


def test_a_jammed_slide_stalls() -> None:
    async def scenario(stand: Stand) -> tuple[RobotState, float]:
        stand.robot.jam()
        began_s = stand.now_s
        state = await stand.move(HOME._replace(rho3_mm=60.0))
        return state, state.sampled_at_s - began_s

    state, after_s = on_stand(scenario)
    assert state.fault is not None
    assert state.fault.code is FaultCode.STALL
    assert state.measured.position.rho3_mm == 50.0
    assert not state.homed, "nothing was seen to slow it down: its encoder may be dead"
    assert 0.1 < after_s < 0.3


def test_a_slide_that_pushes_in_vain_at_the_end_of_its_way_stalls_too() -> None:
    async def scenario(stand: Stand) -> RobotState:
        stand.robot.jam()
        # over before the stall can be noticed
        return await stand.move(HOME._replace(rho3_mm=50.02))

    state = on_stand(scenario)
    assert state.fault is not None
    assert state.fault.code is FaultCode.STALL


def test_a_slide_far_behind_its_set_point_is_a_following_error() -> None:
    async def scenario(stand: Stand) -> RobotState:
        stand.robot.jam()
        return await stand.move(HOME._replace(rho3_mm=80.0))

    state = on_stand(scenario, changed(PERFECT, "board", stall_s=10.0))
    assert state.fault is not None
    assert state.fault.code is FaultCode.FOLLOWING_ERROR
    assert not state.homed


def test_a_freed_slide_works_again() -> None:
    async def scenario(stand: Stand) -> RobotState:
        stand.robot.jam()
        await stand.move(HOME._replace(rho3_mm=60.0))
        stand.robot.free_jam()
        await asyncio.sleep(0.5)
        await stand.robot.clear_fault()
        await stand.robot.home()
        assert (await stand.rest()).homed
        return await stand.move(HOME._replace(rho3_mm=60.0))

    state = on_stand(scenario)
    assert state.fault is None
    assert state.measured.position.rho3_mm == pytest.approx(60.0, abs=0.01)


def test_drives_switch_off_only_at_rest_and_keep_their_place() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        with pytest.raises(BoardRefusedError, match="moves"):
            await stand.robot.disable()
        await stand.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        before = await stand.rest()
        await stand.robot.disable()
        await asyncio.sleep(5.0)
        state = await stand.state()
        assert state.board is BoardState.IDLE
        assert state.measured.position == before.measured.position
        with pytest.raises(BoardRefusedError, match="enable"):
            await stand.robot.push([segment()])

    on_stand(scenario)


@pytest.mark.parametrize("force_n", [0.0, -5.0, 151.0, math.nan])
def test_a_force_limit_that_the_motor_cannot_keep_is_refused(force_n: float) -> None:
    async def scenario(stand: Stand) -> None:
        with pytest.raises(BoardRefusedError, match="force limit"):
            await stand.robot.set_force_limit(force_n)

    on_stand(scenario)
