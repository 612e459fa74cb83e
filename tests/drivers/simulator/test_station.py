from __future__ import annotations

import asyncio

import pytest

from drivers.robot import FaultCode
from drivers.simulator.parameters import SimulationParameters
from drivers.station import PilotState, StationDriver, StationError, StationSnapshot
from tests.drivers.simulator.stand import PERFECT, Stand, changed, on_stand
from twin.joints import JointPosition


async def plugged(stand: Stand) -> JointPosition:
    """Plug in; returns the joints in front of the socket."""
    joints = await stand.align()
    await stand.insert(joints)
    assert stand.world.truth(stand.now_s).seated
    return joints


async def charging(stand: Stand) -> JointPosition:
    """Plug in and charge at full power."""
    joints = await plugged(stand)
    await stand.station.start()
    await asyncio.sleep(5.0)
    assert (await stand.station.snapshot()).power_w == pytest.approx(7360.0, rel=0.02)
    return joints


def test_it_is_a_station_driver() -> None:
    async def scenario(stand: Stand) -> None:
        driver: StationDriver = stand.station
        assert driver.name == "Simulated station"
        assert driver.capabilities.holds
        before_s = stand.now_s
        snapshot = await driver.snapshot()
        assert before_s < snapshot.sampled_at_s < stand.now_s

    on_stand(scenario)


def test_the_pilot_follows_the_plug() -> None:
    async def scenario(stand: Stand) -> list[PilotState]:
        states = [(await stand.station.snapshot()).pilot]
        joints = await stand.align()
        await stand.insert(joints, 37.0)
        states.append((await stand.station.snapshot()).pilot)
        await stand.insert(joints)
        # insert() measures from where align() left the plug
        await stand.move(joints._replace(rho3_mm=joints.rho3_mm + 48.0))
        states.append((await stand.station.snapshot()).pilot)
        await stand.move(joints)
        states.append((await stand.station.snapshot()).pilot)
        return states

    assert on_stand(scenario) == [PilotState.A, PilotState.A, PilotState.B, PilotState.A]


def test_charging_begins_with_the_lock_then_the_contactor_then_the_power() -> None:
    async def scenario(stand: Stand) -> None:
        await plugged(stand)
        before = await stand.station.snapshot()
        assert (before.pilot, before.enabled, before.connector_locked) == (
            PilotState.B,
            False,
            False,
        )
        assert not before.carries_load
        await stand.station.start()
        started_s = stand.now_s
        snapshot = await stand.station.snapshot()
        assert (snapshot.pilot, snapshot.contactor_closed) == (PilotState.C, False)
        assert snapshot.connector_locked
        assert snapshot.carries_load
        while not snapshot.contactor_closed:
            snapshot = await stand.station.snapshot()
        assert 0.5 <= snapshot.sampled_at_s - started_s + 0.03 <= 1.1
        closed = snapshot
        await asyncio.sleep(1.0)
        rising = await stand.station.snapshot()
        assert closed.power_w < rising.power_w < 7360.0
        await asyncio.sleep(6.0)
        full = await stand.station.snapshot()
        assert full.power_w == pytest.approx(7360.0)
        assert full.currents_a == pytest.approx((32.0, 0.0, 0.0))
        await asyncio.sleep(360.0)
        later = await stand.station.snapshot()
        hours = (later.sampled_at_s - full.sampled_at_s) / 3600.0
        assert later.session_energy_wh - full.session_energy_wh == pytest.approx(7360.0 * hours)

    on_stand(scenario)


def test_three_phases_carry_three_times_the_power() -> None:
    async def scenario(stand: Stand) -> StationSnapshot:
        await plugged(stand)
        await stand.station.start()
        await asyncio.sleep(5.0)
        return await stand.station.snapshot()

    snapshot = on_stand(scenario, changed(PERFECT, "station", phases=3, current_a=16.0))
    assert snapshot.power_w == pytest.approx(11_040.0)
    assert snapshot.currents_a == pytest.approx((16.0, 16.0, 16.0))


def test_the_current_flickers_like_a_real_one() -> None:
    async def scenario(stand: Stand) -> list[float]:
        await charging(stand)
        return [(await stand.station.snapshot()).currents_a[0] for _ in range(50)]

    currents = on_stand(scenario, changed(PERFECT, "station", current_noise_std=0.002, name="x"))
    assert 0.02 < max(currents) - min(currents) < 1.0


def test_a_stop_takes_a_second_and_leaves_the_lock_closed() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        await stand.station.stop()
        flowing = await stand.station.snapshot()
        assert not flowing.enabled
        assert flowing.carries_load
        with pytest.raises(StationError, match="locked"):
            await stand.station.unlock()
        await asyncio.sleep(1.0)
        off = await stand.station.snapshot()
        assert not off.carries_load
        assert (off.pilot, off.power_w) == (PilotState.B, 0.0)
        assert off.connector_locked
        assert off.session_energy_wh > 5.0
        await stand.station.unlock()
        assert (await stand.station.snapshot()).connector_locked is False

    on_stand(scenario)


def test_a_start_during_the_reaction_time_keeps_the_power_on() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        await stand.station.stop()
        await asyncio.sleep(0.5)
        await stand.station.start()
        await asyncio.sleep(2.0)
        assert (await stand.station.snapshot()).power_w == pytest.approx(7360.0)

    on_stand(scenario)


def test_a_full_car_ends_the_session_by_itself() -> None:
    async def scenario(stand: Stand) -> None:
        wanted_wh = stand.world.wanted_wh
        await charging(stand)
        await asyncio.sleep(wanted_wh / 7360.0 * 3600.0 + 10.0)
        full = await stand.station.snapshot()
        assert full.session_energy_wh == pytest.approx(wanted_wh)
        assert (full.pilot, full.enabled, full.contactor_closed) == (PilotState.B, True, False)
        assert full.connector_locked
        # enabling again does not charge a full car
        await stand.station.stop()
        await stand.station.start()
        await asyncio.sleep(5.0)
        assert (await stand.station.snapshot()).pilot is PilotState.B

    on_stand(scenario, changed(PERFECT, "car", battery_wh=1000.0))


def test_a_hostile_manager_restarts_a_stopped_station() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        stand.station.restart_by_itself(0.5)
        await stand.station.stop()
        await asyncio.sleep(1.2)
        assert not (await stand.station.snapshot()).carries_load
        await asyncio.sleep(2.0)
        assert (await stand.station.snapshot()).carries_load

    on_stand(scenario)


def test_only_a_hold_keeps_a_hostile_manager_away() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await charging(stand)
        stand.station.restart_by_itself(0.5)
        await stand.station.hold()
        await asyncio.sleep(1.2)
        for _ in range(100):
            snapshot = await stand.station.snapshot()
            assert not snapshot.carries_load
            assert snapshot.held
        with pytest.raises(StationError, match="held"):
            await stand.station.start()
        await stand.station.unlock()
        await stand.move(joints)
        assert stand.world.truth(stand.now_s).load_breaks == 0
        await stand.station.release()
        await asyncio.sleep(1.0)
        snapshot = await stand.station.snapshot()
        assert (snapshot.held, snapshot.enabled, snapshot.pilot) == (False, True, PilotState.A)

    on_stand(scenario)


def test_a_manager_that_has_left_restarts_nothing() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        stand.station.restart_by_itself(0.5)
        await stand.station.stop()
        await asyncio.sleep(1.2)
        stand.station.leave_alone()
        await asyncio.sleep(5.0)
        assert not (await stand.station.snapshot()).carries_load

    on_stand(scenario)


def test_a_locked_plug_stalls_the_withdrawal() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await charging(stand)
        await stand.robot.set_force_limit(85.0)
        state = await stand.move(joints)
        assert state.fault is not None
        assert state.fault.code is FaultCode.STALL
        assert state.force_n == pytest.approx(-85.0, abs=1.0)
        truth = stand.world.truth(stand.now_s)
        assert truth.seated
        assert truth.locked
        assert truth.max_contact_force_n <= 85.0 + 0.01
        # once the station lets go, the plug comes out
        await stand.station.stop()
        await asyncio.sleep(1.5)
        await stand.station.unlock()
        await stand.robot.clear_fault()
        assert (await stand.move(joints)).fault is None
        assert stand.world.truth(stand.now_s).insertion_depth_mm < 0
        assert stand.world.truth().load_breaks == 0

    on_stand(scenario)


def test_pulling_a_plug_under_load_is_written_down() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await charging(stand)
        # a lock that never caught
        stand.world.lock_connector(locked=False, now_s=stand.now_s)
        await stand.move(joints)
        assert stand.world.truth(stand.now_s).load_breaks == 1
        snapshot = await stand.station.snapshot()
        assert (snapshot.pilot, snapshot.power_w) == (PilotState.A, 0.0)

    on_stand(scenario)


def test_a_new_session_counts_from_zero_and_remembers_what_the_car_still_wants() -> None:
    async def scenario(stand: Stand) -> None:
        wanted_wh = stand.world.wanted_wh
        joints = await charging(stand)
        await asyncio.sleep(60.0)
        await stand.station.stop()
        await asyncio.sleep(1.5)
        charged_wh = (await stand.station.snapshot()).session_energy_wh
        assert stand.world.wanted_wh == pytest.approx(wanted_wh - charged_wh)
        await stand.station.unlock()
        await stand.move(joints)
        await stand.insert(joints)
        assert (await stand.station.snapshot()).session_energy_wh == 0.0

    on_stand(scenario)


def test_a_hanging_station_gives_up_after_three_seconds_until_it_behaves() -> None:
    async def scenario(stand: Stand) -> None:
        stand.station.hang()
        for call in (stand.station.snapshot, stand.station.stop, stand.station.hold):
            began_s = stand.now_s
            with pytest.raises(StationError, match="did not answer"):
                await call()
            assert stand.now_s - began_s == pytest.approx(3.0)
        stand.station.behave()
        assert not (await stand.station.snapshot()).held

    on_stand(scenario)


def test_a_lying_station_says_what_it_was_told() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        stand.station.lie(pilot=PilotState.B, contactor_closed=False, currents_a=(0.0, 0.0, 0.0))
        assert not (await stand.station.snapshot()).carries_load
        stand.station.behave()
        assert (await stand.station.snapshot()).carries_load
        with pytest.raises(TypeError):
            stand.station.lie(pillot=PilotState.B)

    on_stand(scenario)


def test_a_frozen_station_repeats_an_old_sample() -> None:
    async def scenario(stand: Stand) -> None:
        stand.station.freeze()
        first = await stand.station.snapshot()
        await asyncio.sleep(5.0)
        assert await stand.station.snapshot() == first
        stand.station.behave()
        assert (await stand.station.snapshot()).sampled_at_s > first.sampled_at_s + 5.0

    on_stand(scenario)


def test_a_closed_station_answers_nothing_and_goes_on() -> None:
    async def scenario(stand: Stand) -> None:
        await charging(stand)
        await stand.station.close()
        await stand.station.close()
        with pytest.raises(StationError, match="not connected"):
            await stand.station.snapshot()
        await stand.station.open()
        assert (await stand.station.snapshot()).power_w == pytest.approx(7360.0)

    on_stand(scenario)


def test_the_default_parameters_have_a_station_too() -> None:
    assert SimulationParameters().station.timeout_s <= 3.0
