from __future__ import annotations

import asyncio
from itertools import pairwise

import numpy as np
import pytest

from drivers.robot import BoardRefusedError, BoardState, FaultCode, StopCategory
from drivers.simulator.homing import trapezoid
from drivers.simulator.parameters import SimulationParameters
from tests.drivers.simulator.stand import GEOMETRY, PERFECT, Stand, changed, on_stand
from twin.joints import JointPosition
from twin.kinematics import LegsCannotCloseError, alpha

UNHOMED = SimulationParameters()


def test_before_homing_the_positions_are_wrong_and_no_motion_is_possible() -> None:
    async def scenario(stand: Stand) -> None:
        state = await stand.state()
        assert not state.homed
        true = stand.world.advance(stand.now_s).carriages
        assert max(abs(m - t) for m, t in zip(state.measured.position, true, strict=True)) > 0.1
        with pytest.raises(BoardRefusedError, match="homing"):
            await stand.robot.push(
                trapezoid(state.commanded.position, (0.0, 0.0, 1.0), 0.01, 1.0, 100.0)
            )

    on_stand(scenario, UNHOMED)


@pytest.mark.parametrize("seed", range(4))
def test_homing_makes_the_positions_true(seed: int) -> None:
    async def scenario(stand: Stand) -> None:
        began_s = stand.now_s
        await stand.robot.home()
        state = await stand.state()
        assert state.homed
        assert state.board is BoardState.READY
        assert state.commanded.position == pytest.approx((150.0, 150.0, 50.0), abs=1e-9)
        assert not any((state.switches.rho1, state.switches.rho2, state.switches.rho3))
        true = stand.world.advance(stand.now_s).carriages
        # repeatability, half the play, half a step
        for measured, carriage in zip(state.measured.position, true, strict=True):
            assert abs(measured - carriage) < 0.035 + 0.025 + 0.003
        assert 8.0 < stand.now_s - began_s < 30.0

    on_stand(scenario, UNHOMED, seed)


def test_homing_repeats_within_hundredths() -> None:
    async def scenario(stand: Stand) -> list[JointPosition]:
        found = []
        for _ in range(4):
            await stand.robot.home()
            found.append(stand.world.advance(stand.now_s).carriages)
        return found

    spread = np.ptp(np.array(on_stand(scenario, UNHOMED)), axis=0)
    assert np.all(spread < 0.06)
    assert np.all(spread > 0.0)


def test_homing_draws_the_plug_back_before_anything_moves_sideways() -> None:
    async def scenario(stand: Stand) -> None:
        homing = asyncio.create_task(stand.robot.home())
        start = (await stand.state()).commanded.position
        while not homing.done():
            state = await stand.state()
            if state.measured.position.rho3_mm > 55.0:
                assert state.commanded.position.rho1_mm == start.rho1_mm
                assert state.commanded.position.rho2_mm == start.rho2_mm
            # all the way the legs close, with room to spare
            rho1, rho2, _ = state.commanded.position
            assert alpha.forward(GEOMETRY, rho1, rho2).y_mm > 200.0
        await homing

    far_out = changed(UNHOMED, "board", start_joints=JointPosition(330.0, 20.0, 90.0))
    on_stand(scenario, far_out)


@pytest.mark.parametrize("joints", [(20.0, 330.0, 60.0), (380.0, 380.0, 140.0)])
def test_homing_works_from_everywhere(joints: tuple[float, float, float]) -> None:
    async def scenario(stand: Stand) -> None:
        stand.world.remove_car()
        await stand.robot.home()
        assert (await stand.state()).homed

    on_stand(scenario, changed(UNHOMED, "board", start_joints=JointPosition(*joints)))


def test_a_pose_in_which_the_legs_cannot_close_is_no_place_to_start() -> None:
    async def scenario(_: Stand) -> None:
        pytest.fail("the garage was built")

    with pytest.raises(LegsCannotCloseError):
        on_stand(scenario, changed(PERFECT, "board", start_joints=JointPosition(0.0, 0.0, 50.0)))


@pytest.mark.parametrize("after_s", [0.0, 0.1, 1.0, 4.0, 9.0])
def test_a_stop_ends_homing(after_s: float) -> None:
    async def scenario(stand: Stand) -> None:
        homing = asyncio.create_task(stand.robot.home())
        await asyncio.sleep(after_s)
        await stand.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        with pytest.raises(BoardRefusedError, match="stopped"):
            await homing
        state = await stand.rest()
        assert state.board is BoardState.READY
        assert not state.homed
        await stand.robot.home()
        assert (await stand.state()).homed

    on_stand(scenario, UNHOMED)


def test_a_cut_switch_wire_makes_homing_fail() -> None:
    async def scenario(stand: Stand) -> None:
        stand.robot.trip_limit(0)
        with pytest.raises(BoardRefusedError, match="does not open"):
            await stand.robot.home()
        state = await stand.rest()
        assert state.fault is not None
        assert state.fault.code is FaultCode.HOMING_FAILED
        assert not state.homed

    on_stand(scenario, UNHOMED)


def test_a_jammed_slide_makes_homing_fail() -> None:
    async def scenario(stand: Stand) -> None:
        stand.robot.jam()
        with pytest.raises(BoardRefusedError, match="fault"):
            await stand.robot.home()
        state = await stand.rest()
        assert state.fault is not None
        assert state.fault.code is FaultCode.STALL

    on_stand(scenario, UNHOMED)


def test_homing_goes_on_when_nobody_waits_for_it() -> None:
    async def scenario(stand: Stand) -> None:
        homing = asyncio.create_task(stand.robot.home())
        await asyncio.sleep(0.5)
        homing.cancel()
        await asyncio.sleep(30.0)
        assert (await stand.state()).homed

    on_stand(scenario, UNHOMED)


@pytest.mark.parametrize("distance_mm", [0.001, 1.0, 12.0, 200.0])
def test_a_trapezoid_goes_the_whole_way_from_rest_to_rest(distance_mm: float) -> None:
    start = JointPosition(10.0, 20.0, 60.0)
    segments = trapezoid(start, (-1.0, 1.0, 0.0), distance_mm, 60.0, 300.0)
    assert segments[-1].end == pytest.approx((10.0 - distance_mm, 20.0 + distance_mm, 60.0))
    assert segments[-1].end_velocity == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert max(abs(s.end_velocity.rho1_mm_s) for s in segments) <= 60.0 + 1e-9
    for one, two in pairwise(segments):
        assert two.start == one.end
        assert two.velocity == one.end_velocity
