from __future__ import annotations

import asyncio
import gc
from itertools import pairwise

import pytest

from drivers.camera import pi_camera_v2
from drivers.robot import (
    BoardState,
    FaultCode,
    NotConnectedError,
    RobotDriver,
    RobotState,
    StopCategory,
)
from drivers.robot.link_health import LinkHealth, RoundTrip, TellsLinkHealth
from drivers.robot.telemetry_feed import KEPT_SAMPLES
from drivers.simulator.garage import build_garage
from tests.drivers.simulator.stand import GEOMETRY, HOMED, LIMITS, PERFECT, Stand, on_stand, run
from twin.camera_mount import CameraMount
from twin.joints import JointPosition

AWAY = JointPosition(250.0, 170.0, 60.0)


def test_it_is_a_robot_driver() -> None:
    async def scenario(stand: Stand) -> None:
        driver: RobotDriver = stand.robot
        identity = await driver.connect()
        assert identity.name == "Simulator"
        assert identity.queue_capacity == 16
        assert identity.segment_s == 0.02

    on_stand(scenario)


def test_nothing_works_before_the_link_is_open() -> None:
    async def main() -> None:
        robot = build_garage(GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), PERFECT, seed=1).robot
        with pytest.raises(NotConnectedError):
            robot.telemetry()
        with pytest.raises(NotConnectedError):
            await robot.enable()
        await robot.close()

    run(main())


def test_telemetry_comes_at_a_hundred_hertz_moving_and_ten_at_rest() -> None:
    async def scenario(stand: Stand) -> tuple[list[RobotState], list[RobotState]]:
        await stand.move(AWAY)
        moving = [s for s in stand.samples if s.board is BoardState.RUN]
        rest = []
        await asyncio.sleep(0.2)
        async for sample in stand.robot.telemetry():
            rest.append(sample)
            if len(rest) == 20:
                break
        return moving, rest

    moving, rest = on_stand(scenario, HOMED)
    assert len(moving) > 100
    periods = [b.sampled_at_s - a.sampled_at_s for a, b in pairwise(moving)]
    assert periods == pytest.approx([0.01] * len(periods), abs=1e-6)
    periods = [b.sampled_at_s - a.sampled_at_s for a, b in pairwise(rest)]
    assert periods == pytest.approx([0.1] * len(periods), abs=1e-6)
    delays = [s.received_at_s - s.sampled_at_s for s in (*moving, *rest)]
    assert 0.006 <= min(delays) < 0.0065
    assert 0.0095 < max(delays) <= 0.010001


def test_a_motion_is_reported_at_once_after_a_rest() -> None:
    async def scenario(stand: Stand) -> float:
        segments = await stand.segments_to(AWAY)
        await asyncio.sleep(0.03)
        pushed_s = stand.now_s
        telemetry = stand.robot.telemetry()
        await stand.robot.push(segments[:16])
        async for sample in telemetry:
            if sample.board is BoardState.RUN:
                return sample.received_at_s - pushed_s
        raise AssertionError

    assert on_stand(scenario) < 0.015


def test_every_reader_gets_every_sample() -> None:
    async def scenario(stand: Stand) -> list[list[float]]:
        async def read() -> list[float]:
            times = []
            async for sample in stand.robot.telemetry():
                times.append(sample.sampled_at_s)
                if len(times) == 30:
                    break
            return times

        readers = [asyncio.create_task(read()) for _ in range(3)]
        await asyncio.sleep(0)
        await stand.move(AWAY)
        return list(await asyncio.gather(*readers))

    one, two, three = on_stand(scenario)
    assert one == two == three


def test_a_slow_reader_loses_the_oldest_samples_and_holds_nobody_up() -> None:
    async def scenario(stand: Stand) -> tuple[list[RobotState], float]:
        slow = stand.robot.telemetry()
        await stand.move(AWAY)
        await asyncio.sleep(1.0)
        kept = []
        async for sample in slow:
            kept.append(sample)
            if len(kept) == KEPT_SAMPLES:
                break
        return kept, stand.now_s

    kept, now_s = on_stand(scenario)
    assert now_s - kept[-1].sampled_at_s < 0.12
    # the first kept sample is not the first that was sent
    assert kept[0].sampled_at_s > 1.0


def test_a_reader_that_is_gone_is_forgotten() -> None:
    async def scenario(stand: Stand) -> None:
        async for _ in stand.robot.telemetry():
            break
        gc.collect()
        assert len(stand.robot._feed._readers) == 0

    on_stand(scenario)


def test_an_unplugged_cable_stops_the_robot_and_ends_the_telemetry() -> None:
    async def scenario(stand: Stand) -> None:
        segments = await stand.segments_to(AWAY)
        await stand.robot.push(segments[:16])
        telemetry = stand.robot.telemetry()
        await anext(telemetry)
        await asyncio.sleep(0.004)  # the next sample is on its way now, and gets lost
        unplugged_s = stand.now_s
        stand.robot.unplug_link()
        with pytest.raises(NotConnectedError):
            await stand.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        last = [sample async for sample in telemetry]
        assert stand.now_s - unplugged_s == pytest.approx(0.3, abs=0.01)
        assert all(s.received_at_s <= unplugged_s for s in last)
        with pytest.raises(NotConnectedError):
            stand.robot.telemetry()

        await asyncio.sleep(1.0)
        assert stand.world.advance(stand.now_s).velocity == (0.0, 0.0, 0.0)
        stand.robot.replug_link()
        with pytest.raises(NotConnectedError):
            stand.robot.telemetry()
        await asyncio.sleep(0.6)
        state = await stand.state()
        assert state.fault is not None
        assert state.fault.code is FaultCode.HEARTBEAT_LOST
        assert not state.enabled
        assert state.homed

    on_stand(scenario)


def test_a_board_without_a_host_stops_within_its_heartbeat() -> None:
    async def scenario(stand: Stand) -> None:
        segments = await stand.segments_to(AWAY)
        await stand.robot.push(segments[:16])
        await asyncio.sleep(0.02)
        stand.robot.unplug_link()
        await asyncio.sleep(0.19)
        assert stand.world.advance(stand.now_s).velocity.rho1_mm_s > 10.0
        await asyncio.sleep(0.1)
        assert stand.world.advance(stand.now_s).velocity.rho1_mm_s == 0.0

    on_stand(scenario)


def test_a_short_glitch_of_the_cable_goes_unnoticed() -> None:
    async def scenario(stand: Stand) -> None:
        telemetry = stand.robot.telemetry()
        stand.robot.unplug_link()
        await asyncio.sleep(0.1)
        stand.robot.replug_link()
        await asyncio.sleep(1.0)
        assert stand.robot.link_health().reconnections == 0
        assert (await anext(telemetry)).fault is None
        assert (await stand.state()).fault is None

    on_stand(scenario)


def test_a_simulated_link_tells_what_is_modelled_and_makes_nothing_up() -> None:
    async def scenario(stand: Stand) -> None:
        robot = stand.robot
        assert isinstance(robot, TellsLinkHealth)
        there_and_back_s = 2 * PERFECT.board.command_delay_s
        times = RoundTrip(there_and_back_s, there_and_back_s, there_and_back_s, 1)
        assert robot.link_health() == LinkHealth(reconnections=0, round_trip=times)
        asked_s = stand.now_s
        await robot.set_force_limit(50.0)
        assert stand.now_s - asked_s == pytest.approx(there_and_back_s)
        robot.unplug_link()
        await asyncio.sleep(1.0)
        assert robot.link_health() == LinkHealth(reconnections=0)
        robot.replug_link()
        await asyncio.sleep(1.0)
        assert robot.link_health() == LinkHealth(reconnections=1, round_trip=times)

    on_stand(scenario)


def test_a_link_lost_during_homing_says_so() -> None:
    async def scenario(stand: Stand) -> None:
        homing = asyncio.create_task(stand.robot.home())
        await asyncio.sleep(2.0)
        stand.robot.unplug_link()
        with pytest.raises(NotConnectedError):
            await homing

    on_stand(scenario)


def test_connecting_to_an_unplugged_board_fails() -> None:
    async def main() -> None:
        robot = build_garage(GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), PERFECT, seed=1).robot
        robot.unplug_link()
        with pytest.raises(NotConnectedError, match="USB"):
            await robot.connect()

    run(main())


def test_closing_stops_the_robot_and_ends_the_telemetry() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        telemetry = stand.robot.telemetry()
        await asyncio.sleep(0.1)
        await stand.robot.close()
        await stand.robot.close()
        assert [s async for s in telemetry]
        assert stand.world.advance(stand.now_s).velocity == (0.0, 0.0, 0.0)
        with pytest.raises(NotConnectedError):
            await stand.robot.enable()
        await stand.robot.connect()
        state = await stand.state()
        assert state.board is BoardState.IDLE
        assert state.homed

    on_stand(scenario)


def test_a_command_on_its_way_takes_effect_even_if_nobody_waits() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        stopping = asyncio.create_task(stand.robot.stop(StopCategory.DECELERATE_AND_HOLD))
        await asyncio.sleep(0)
        stopping.cancel()
        await asyncio.sleep(0.1)
        state = await stand.state()
        assert state.board is BoardState.READY
        assert state.fault is None

    on_stand(scenario)
