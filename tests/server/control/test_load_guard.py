"""Who proves that no current flows, what counts as a proof, and what ends it."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import Any

import pytest

from drivers.station import PilotState, StationAnswerError, StationCapabilities
from server.config.supervision import SupervisionSettings
from server.control.errors import (
    ControlError,
    LateralMotionForbiddenError,
    StationUnsafeError,
    StillUnderLoadError,
)
from server.control.load_guard import LoadGuard
from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugRecord
from tests.support.robot_cell import MemoryPlug, RobotCell, in_cell, parameters
from tests.support.scripted_station import ScriptedStation
from tests.support.virtual import run_virtual
from twin.joints import JointPosition

SETTINGS = SupervisionSettings()
SAMPLE_S = SETTINGS.station_sample_s + 0.02
"""Period and answer."""


def guarded(scenario: Callable[[LoadGuard, ScriptedStation], Awaitable[None]]) -> None:
    async def main() -> None:
        station = ScriptedStation()
        await scenario(LoadGuard(station, SETTINGS), station)

    run_virtual(main())


def now_s() -> float:
    return asyncio.get_running_loop().time()


def test_without_a_watch_nothing_is_proven() -> None:
    async def scenario(guard: LoadGuard, _: ScriptedStation) -> None:
        with pytest.raises(StationUnsafeError, match="nobody has made sure"):
            guard.require()
        async with guard.watching():
            guard.require()
        with pytest.raises(StationUnsafeError, match="nobody has made sure"):
            guard.require()

    guarded(scenario)


def test_a_proof_takes_two_new_readings() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        await guard.prove()
        assert station.answers == 2

    guarded(scenario)


@pytest.mark.parametrize(
    ("says", "error"),
    [
        ({"pilot": PilotState.C}, StillUnderLoadError),
        ({"enabled": True}, StillUnderLoadError),
        ({"contactor_closed": True}, StillUnderLoadError),
        ({"currents_a": (0.0, 0.0, 0.6)}, StillUnderLoadError),
        ({"currents_a": (0.0, math.nan, 0.0)}, StillUnderLoadError),
        ({"power_w": 1400.0}, StillUnderLoadError),
        ({"power_w": math.nan}, StillUnderLoadError),
        ({"sampled_at_s": -5.0}, StationUnsafeError),
        ({"sampled_at_s": 3600.0}, StationUnsafeError),
        ({"sampled_at_s": math.nan}, StationUnsafeError),
    ],
)
def test_what_is_no_proof(says: dict[str, Any], error: type[ControlError]) -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        station.says = says
        with pytest.raises(error):
            await guard.prove()
        with pytest.raises(error):
            async with guard.watching():
                raise AssertionError("nothing was proven")

    guarded(scenario)


def test_readings_from_before_the_question_prove_nothing() -> None:
    """Otherwise an answer from before the command to stop would count as its effect."""

    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        await asyncio.sleep(1.0)
        station.age_s = 0.5
        with pytest.raises(StationUnsafeError):
            await guard.prove()

    guarded(scenario)


def test_a_manager_that_only_repeats_what_it_heard_never_proves_anything() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        station.capabilities = replace(station.capabilities, fresh=False)
        with pytest.raises(StationUnsafeError, match=r"station\.manager"):
            await guard.prove()

    guarded(scenario)


def test_a_station_that_cannot_be_switched_may_be_enabled() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        station.capabilities = StationCapabilities(switches=False, holds=False, unlocks=False)
        station.says = {"enabled": True}
        await guard.prove()
        station.says = {"enabled": True, "pilot": PilotState.C}
        with pytest.raises(StillUnderLoadError):
            await guard.prove()

    guarded(scenario)


def test_patience_waits_for_the_current_to_stop_and_two_good_readings_after_that() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        station.says = {"contactor_closed": True}
        asyncio.get_running_loop().call_later(5.0, station.says.clear)
        await guard.prove(patience_s=10.0)
        assert 5.1 < now_s() < 5.5
        station.says = {"contactor_closed": True}
        began_s = now_s()
        with pytest.raises(StillUnderLoadError):
            await guard.prove(patience_s=10.0)
        assert now_s() - began_s == pytest.approx(10.0, abs=0.3)

    guarded(scenario)


def test_one_lost_answer_is_no_silence() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        alarms: list[ControlError] = []
        guard.on_alarm = alarms.append
        async with guard.watching():
            await asyncio.sleep(1.0)
            station.failure = StationAnswerError("<!DOCTYPE html>")
            await asyncio.sleep(0.5)
            station.failure = None
            await asyncio.sleep(2.0)
            station.silent = True
            await asyncio.sleep(0.3)
            station.silent = False
            await asyncio.sleep(2.0)
            guard.require()
        assert not alarms

    guarded(scenario)


@pytest.mark.parametrize("how", ["silent", "fails", "repeats itself"])
def test_silence_is_an_alarm_when_the_last_reading_is_too_old(how: str) -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        alarmed_at_s: list[float] = []
        guard.on_alarm = lambda _: alarmed_at_s.append(now_s())
        async with guard.watching():
            await asyncio.sleep(1.0)
            began_s = now_s()
            match how:
                case "silent":
                    station.silent = True
                case "fails":
                    station.failure = StationAnswerError("<!DOCTYPE html>")
                case _:
                    station.says = {"sampled_at_s": now_s()}
            await asyncio.sleep(3.0)
            with pytest.raises(StationUnsafeError):
                guard.require()
        (at_s,) = alarmed_at_s
        limit_s = SETTINGS.station_age_s
        assert limit_s - SAMPLE_S <= at_s - began_s <= limit_s + SAMPLE_S

    guarded(scenario)


def test_load_is_an_alarm_within_one_sample_and_stays_one_until_a_new_proof() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        alarmed_at_s: list[float] = []
        guard.on_alarm = lambda _: alarmed_at_s.append(now_s())
        async with guard.watching():
            await asyncio.sleep(1.037)
            began_s = now_s()
            station.says = {"pilot": PilotState.C}
            await asyncio.sleep(0.5)
            station.says = {}
            await asyncio.sleep(1.0)
            with pytest.raises(StillUnderLoadError):
                guard.require()
        assert 0.0 < alarmed_at_s[0] - began_s <= SAMPLE_S
        async with guard.watching():
            guard.require()

    guarded(scenario)


def test_a_watch_that_breaks_down_is_an_alarm() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        async with guard.watching():
            station.failure = ZeroDivisionError()  # type: ignore[assignment]
            await asyncio.sleep(1.0)
            with pytest.raises(StationUnsafeError, match="log"):
                guard.require()

    guarded(scenario)


def test_two_who_watch_share_one_watch() -> None:
    async def scenario(guard: LoadGuard, station: ScriptedStation) -> None:
        async with guard.watching():
            async with guard.watching():
                guard.require()
            guard.require()
            station.says = {"enabled": True}
            await asyncio.sleep(0.5)
            with pytest.raises(StillUnderLoadError):
                async with guard.watching():
                    raise AssertionError("it is under load")

    guarded(scenario)


IN_SOCKET = JointPosition(150.0, 150.0, 110.0)
CORRIDOR = Corridor(150.0, 150.0, 55.0, 75.0, 115.0)


@pytest.mark.parametrize("state", [PlugState.INSERTED, PlugState.UNKNOWN])
def test_a_held_plug_moves_for_nobody_without_a_proof(state: PlugState) -> None:
    async def scenario(cell: RobotCell) -> None:
        supervisor, station = cell.supervisor, cell.garage.station
        at = cell.robot.commanded.position
        async with supervisor.control("job", "Test") as lease:
            with pytest.raises(StationUnsafeError):
                await supervisor.move_joints(lease, at._replace(rho3_mm=100.0))
            with pytest.raises(StationUnsafeError):
                await supervisor.withdraw_home(lease)
            station.lie(currents_a=(10.0, 0.0, 0.0))
            with pytest.raises(StillUnderLoadError):
                async with supervisor.plug_may_move():
                    raise AssertionError("it is under load")
        with pytest.raises(StillUnderLoadError):
            await cell.jog.step("rho3", -5.0, 5.0)
        cell.jog.hold("rho3", -1, 5.0)
        await cell.jog.wait_stopped()
        assert cell.now == pytest.approx(at, abs=0.02)
        station.behave()
        await cell.jog.step("rho3", -5.0, 5.0)
        assert cell.now.rho3_mm == pytest.approx(at.rho3_mm - 5.0, abs=0.05)
        with pytest.raises(LateralMotionForbiddenError):
            await cell.jog.step("rho1", 5.0, 5.0)

    record = PlugRecord(state, CORRIDOR if state is PlugState.INSERTED else None)
    in_cell(scenario, parameters(start_joints=IN_SOCKET), store=MemoryPlug(record))


@pytest.mark.parametrize("blind", [False, True])
def test_a_load_stops_whatever_moves_within_one_sample(*, blind: bool) -> None:
    async def scenario(cell: RobotCell) -> None:
        supervisor = cell.supervisor
        async with supervisor.control("job", "Test") as lease, supervisor.plug_may_move():
            away = IN_SOCKET._replace(rho3_mm=60.0)
            work = supervisor.withdraw_home(lease) if blind else supervisor.move_joints(lease, away)
            task = asyncio.create_task(work)
            await asyncio.sleep(1.5)
            assert cell.moving()
            began_s = now_s()
            cell.garage.station.lie(contactor_closed=True)
            while cell.moving():  # noqa: ASYNC110 - virtual time
                await asyncio.sleep(0.001)
            # a period, question and answer, the way to the board, 12 mm/s at 400 mm/s^2
            assert now_s() - began_s < 0.1 + 0.06 + 0.002 + 0.035
            with pytest.raises(StillUnderLoadError):
                await task
        assert cell.supervisor.plug.state is not PlugState.FREE

    record = PlugRecord(PlugState.INSERTED, CORRIDOR)
    in_cell(scenario, parameters(start_joints=IN_SOCKET), store=MemoryPlug(record))
