from __future__ import annotations

import asyncio
import time

import numpy as np
import pytest

from drivers.robot import BoardState, FaultCode, RobotState
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.world import CarIsPluggedInError
from tests.drivers.simulator.stand import HOMED, PERFECT, Stand, on_stand


async def plug_in_and_out(stand: Stand) -> list[RobotState]:
    joints = await stand.align()
    await stand.insert(joints)
    await stand.station.start()
    await asyncio.sleep(4.0)
    await stand.station.stop()
    await asyncio.sleep(1.5)
    await stand.station.unlock()
    await stand.move(joints)
    return stand.samples


@pytest.mark.parametrize("seed", range(5))
def test_an_aligned_plug_goes_in_and_comes_out(seed: int) -> None:
    async def scenario(stand: Stand) -> None:
        joints = await stand.align()
        state = await stand.insert(joints)
        truth = stand.world.truth(stand.now_s)
        assert state.fault is None
        assert truth.seated
        assert truth.lateral_error_mm < 0.15
        # 70 N, their scatter, and what up to 2 degrees of tilt add
        assert 62.0 < truth.max_contact_force_n < 90.0
        felt = max(s.force_n for s in stand.samples)
        assert felt == pytest.approx(truth.max_contact_force_n, abs=8.0)
        await stand.move(joints)
        truth = stand.world.truth(stand.now_s)
        assert not truth.seated
        assert truth.lateral_violation_mm == 0.0
        assert min(s.force_n for s in stand.samples) < -40.0

    on_stand(scenario, HOMED, seed)


def test_a_plug_that_misses_stops_at_its_cap_and_can_be_drawn_back() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await stand.align(off_mm=2.5)
        await stand.robot.set_force_limit(30.0)
        state = await stand.insert(joints)
        assert state.fault is not None
        assert state.fault.code is FaultCode.STALL
        truth = stand.world.truth(stand.now_s)
        assert truth.jammed
        assert truth.max_contact_force_n <= 30.0 * 1.05
        await stand.robot.clear_fault()
        assert (await stand.move(joints)).fault is None
        assert stand.world.truth(stand.now_s).contact_force_n == 0.0

    on_stand(scenario, HOMED)


def test_the_same_seed_gives_the_same_run_to_the_last_bit() -> None:
    first = on_stand(plug_in_and_out, HOMED, 7)
    assert on_stand(plug_in_and_out, HOMED, 7) == first
    assert on_stand(plug_in_and_out, HOMED, 8) != first


def test_without_homing_the_same_seed_gives_the_same_run_too() -> None:
    async def scenario(stand: Stand) -> list[RobotState]:
        await stand.robot.home()
        return await plug_in_and_out(stand)

    parameters = SimulationParameters()
    assert on_stand(scenario, parameters, 3) == on_stand(scenario, parameters, 3)


def test_another_car_parks_elsewhere() -> None:
    async def scenario(stand: Stand) -> None:
        before = stand.world.car.T_base_socket
        stand.world.park_car(5)
        one = stand.world.car.T_base_socket
        stand.world.park_car(6)
        stand.world.park_car(5)
        assert not np.array_equal(before, one)
        assert np.array_equal(stand.world.car.T_base_socket, one)
        joints = await stand.align()
        await stand.insert(joints)
        assert stand.world.truth(stand.now_s).seated
        for leave in (stand.world.remove_car, lambda: stand.world.park_car(7)):
            with pytest.raises(CarIsPluggedInError):
                leave()

    on_stand(scenario)


def test_there_is_nothing_to_touch_without_a_car() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await stand.align()
        stand.world.remove_car()
        state = await stand.move(joints._replace(rho3_mm=150.0))
        assert state.board is BoardState.READY
        truth = stand.world.truth(stand.now_s)
        assert truth.max_contact_force_n == 0.0
        assert not truth.seated

    on_stand(scenario)


def test_a_resting_garage_costs_next_to_nothing() -> None:
    async def scenario(stand: Stand) -> float:
        await plug_in_and_out(stand)
        await asyncio.sleep(1.0)
        began_s = time.process_time()
        await asyncio.sleep(600.0)
        return (time.process_time() - began_s) / 600.0

    # a share of one core; measured below 0.001
    assert on_stand(scenario, PERFECT) < 0.005


def test_a_job_costs_little_computing() -> None:
    async def scenario(stand: Stand) -> float:
        began_s, clock_s = time.process_time(), stand.now_s
        await plug_in_and_out(stand)
        return (time.process_time() - began_s) / (stand.now_s - clock_s)

    # share of one core, the planning of this test included; measured about 0.04
    assert on_stand(scenario, HOMED) < 0.25
