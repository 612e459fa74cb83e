from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Any

import pytest

from drivers.robot import BoardState, FaultCode, RobotState
from server.control.errors import (
    ControlBusyError,
    ControlLostError,
    RobotOfflineError,
    StationUnsafeError,
)
from server.control.model import PlugState, RobotMode
from server.control.plug_guard import Corridor, PlugRecord
from server.live.views import robot_view
from server.storage.errors import StorageError
from server.timing import Calendar
from tests.support.robot_cell import AWAY, HOME, MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import wait_until
from twin.joints import JointPosition

CORRIDOR = Corridor(150.0, 150.0, 55.0, 75.0, 115.0)
INSIDE = JointPosition(150.0, 150.0, 110.0)


async def lose_the_link(cell: RobotCell) -> None:
    cell.garage.robot.unplug_link()
    await wait_until(lambda: cell.mode() is RobotMode.OFFLINE)


async def find_the_link(cell: RobotCell) -> None:
    cell.garage.robot.replug_link()
    await wait_until(lambda: cell.mode() is not RobotMode.OFFLINE)


def test_a_link_lost_in_mid_motion_ends_it_and_gives_the_lease_back() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def go() -> None:
            async with cell.supervisor.control("job", "Test") as lease:
                await cell.supervisor.move_joints(lease, JointPosition(300.0, 60.0, 50.0))

        task = asyncio.create_task(go())
        await asyncio.sleep(0.8)
        await lose_the_link(cell)
        with pytest.raises(RobotOfflineError):
            await task
        assert not cell.moving(), "the board has stopped by itself"
        assert cell.holder() is None
        assert cell.supervisor.telemetry.latest is None
        with pytest.raises(RobotOfflineError):
            cell.supervisor.telemetry.joints_at(0.0)
        async with cell.supervisor.control("job", "Test") as lease:
            for call in (cell.supervisor.enable, cell.supervisor.disable, cell.supervisor.home):
                with pytest.raises(RobotOfflineError):
                    await call(lease)
            with pytest.raises(RobotOfflineError):
                await cell.supervisor.set_force_limit(lease, 50.0)
        await find_the_link(cell)
        assert cell.supervisor.fault is not None
        assert cell.supervisor.fault.code is FaultCode.HEARTBEAT_LOST, "before the queue was empty"
        await cell.supervisor.reset()
        async with cell.supervisor.control("job", "Test") as lease:
            await cell.supervisor.enable(lease)
            state = await cell.supervisor.move_joints(lease, AWAY)
        assert state.commanded.position == pytest.approx(AWAY, abs=0.02)

    in_cell(scenario)


@pytest.mark.parametrize(
    ("record", "numbers", "expected"),
    [
        pytest.param(
            PlugRecord(PlugState.PARKED, None), {}, PlugState.PARKED, id="parked and at home"
        ),
        pytest.param(
            PlugRecord(PlugState.PARKED, None),
            {"start_homed": False},
            PlugState.FREE,
            id="parked, but the place is no longer known",
        ),
        pytest.param(
            PlugRecord(PlugState.INSERTED, CORRIDOR),
            {"start_joints": INSIDE},
            PlugState.INSERTED,
            id="in the socket where it was left",
        ),
        pytest.param(
            PlugRecord(PlugState.INSERTED, CORRIDOR),
            {"start_joints": INSIDE, "start_homed": False},
            PlugState.UNKNOWN,
            id="in the socket, but positions are lost",
        ),
        pytest.param(
            PlugRecord(PlugState.INSERTED, CORRIDOR),
            {"start_joints": INSIDE._replace(rho1_mm=152.0)},
            PlugState.UNKNOWN,
            id="beside the way into the socket",
        ),
        pytest.param(
            PlugRecord(PlugState.INSERTED, None),
            {"start_joints": INSIDE},
            PlugState.UNKNOWN,
            id="in a socket nobody remembers",
        ),
        pytest.param(
            PlugRecord(PlugState.UNKNOWN, None), {}, PlugState.UNKNOWN, id="unknown stays unknown"
        ),
    ],
)
def test_the_record_about_the_plug_meets_the_evidence_at_power_up(
    record: PlugRecord, numbers: dict[str, Any], expected: PlugState
) -> None:
    async def scenario(cell: RobotCell) -> tuple[PlugState, PlugRecord]:
        return cell.plug(), cell.store.records[-1]

    state, on_disk = in_cell(
        scenario, parameters(**numbers), store=MemoryPlug(record), enabled=False
    )
    assert state is expected
    assert on_disk.state is expected, "what is on disk is what counts after a power cut"


def test_an_inserted_plug_is_still_in_its_corridor_after_the_link_was_lost() -> None:
    async def scenario(cell: RobotCell) -> None:
        await lose_the_link(cell)
        await find_the_link(cell)
        await asyncio.sleep(0.5)
        assert cell.plug() is PlugState.INSERTED
        assert cell.supervisor.plug.corridor == CORRIDOR

    store = MemoryPlug(PlugRecord(PlugState.INSERTED, CORRIDOR))
    in_cell(scenario, parameters(start_joints=INSIDE), store=store)


def test_positions_lost_while_connected_make_the_plug_unknown_at_once() -> None:
    """Otherwise the way out would be planned in coordinates that no longer hold."""

    async def scenario(cell: RobotCell) -> None:
        async with (
            cell.supervisor.control("job", "Test") as lease,
            cell.supervisor.plug_may_move(),
        ):
            plan = asyncio.create_task(
                cell.supervisor.move_joints(lease, INSIDE._replace(rho3_mm=60.0))
            )
            await asyncio.sleep(0.5)
            cell.garage.robot.trip_limit(0)
            await asyncio.wait([plan])
            assert plan.exception() is not None
        assert not cell.robot.homed
        assert cell.plug() is PlugState.UNKNOWN
        assert cell.store.records[-1].state is PlugState.UNKNOWN
        cell.garage.robot.mend_limit(0)
        await cell.supervisor.reset()
        async with cell.supervisor.control("homing", "Test") as lease:
            with pytest.raises(StationUnsafeError):
                await cell.supervisor.withdraw_home(lease)
            async with cell.supervisor.plug_may_move():
                await cell.supervisor.withdraw_home(lease)
        assert cell.plug() is PlugState.FREE

    store = MemoryPlug(PlugRecord(PlugState.INSERTED, CORRIDOR))
    in_cell(scenario, parameters(start_joints=INSIDE), store=store)


def test_a_second_holder_is_told_the_first_ones_name() -> None:
    async def scenario(cell: RobotCell) -> None:
        lease = cell.supervisor.acquire("job", "Charging job")
        with pytest.raises(ControlBusyError, match="Charging job") as raised:
            cell.supervisor.acquire("jog", "A technician")
        assert raised.value.context == {"holder": "Charging job", "holder_kind": "job"}
        cell.supervisor.give_back(lease)
        cell.supervisor.give_back(lease)
        other = cell.supervisor.acquire("jog", "A technician")
        cell.supervisor.give_back(lease)
        assert cell.holder() == other.holder, "an old lease ends only itself"
        with pytest.raises(ControlLostError):
            await cell.supervisor.move_joints(lease, AWAY)
        assert not cell.moving()

    in_cell(scenario)


def test_a_disk_that_fails_when_the_link_comes_up_does_not_end_the_link() -> None:
    async def scenario(cell: RobotCell) -> None:
        assert cell.mode() is RobotMode.OFFLINE
        assert cell.plug() is PlugState.UNKNOWN, "doubt holds, written or not"
        cell.store.failure = None
        await wait_until(lambda: cell.mode() is not RobotMode.OFFLINE, 5.0)
        assert cell.plug() is PlugState.UNKNOWN
        await cell.supervisor.plug.is_free()
        assert cell.store.records[-1].state is PlugState.FREE

    store = MemoryPlug(PlugRecord(PlugState.INSERTED, None))
    store.failure = StorageError("The disk is full.")
    in_cell(scenario, store=store, enabled=False)


def test_a_listener_that_fails_stops_neither_the_link_nor_the_others() -> None:
    async def scenario(cell: RobotCell) -> None:
        def fail() -> None:
            raise ZeroDivisionError

        told: list[RobotMode] = []
        cell.supervisor.listen(fail)
        cell.supervisor.listen(lambda: told.append(cell.mode()))
        async with cell.supervisor.control("job", "Test") as lease:
            await cell.supervisor.move_joints(lease, AWAY)
        assert RobotMode.MOVING in told
        assert cell.mode() is RobotMode.READY

    in_cell(scenario)


def test_closing_ends_a_motion_and_leaves_the_robot_at_rest() -> None:
    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("job", "Test") as lease:
            motion = asyncio.create_task(
                cell.supervisor.move_joints(lease, JointPosition(300.0, 60.0, 50.0))
            )
            await asyncio.sleep(0.8)
            await cell.supervisor.close()
            assert not cell.moving()
            with pytest.raises(RobotOfflineError):
                await motion

    in_cell(scenario)


def test_joints_are_interpolated_in_the_recent_past() -> None:
    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("job", "Test") as lease:
            await cell.supervisor.move_joints(lease, AWAY)
        telemetry = cell.supervisor.telemetry
        run = [sample for sample in cell.samples if sample.board is BoardState.RUN]
        before, after = run[40], run[41]
        middle_s = (before.sampled_at_s + after.sampled_at_s) / 2
        expected = (before.measured.position.rho1_mm + after.measured.position.rho1_mm) / 2
        assert telemetry.joints_at(middle_s).rho1_mm == pytest.approx(expected)
        assert telemetry.joints_at(before.sampled_at_s) == before.measured.position
        assert telemetry.joints_at(1e9) == telemetry.require().measured.position
        assert telemetry.joints_at(-1.0) != telemetry.require().measured.position
        newest = await telemetry.reach(telemetry.require().sampled_at_s + 1.0)
        oldest = telemetry.joints_at(newest.sampled_at_s - 100.0)
        assert oldest != HOME, "the history is a short one"

    in_cell(scenario)


def test_whoever_waits_for_telemetry_learns_that_the_link_is_gone() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def read() -> AsyncIterator[RobotState]:
            while True:
                yield await cell.supervisor.telemetry.next()

        cell.garage.robot.unplug_link()
        began_s = asyncio.get_running_loop().time()
        with pytest.raises(RobotOfflineError):
            async for _ in read():
                pass
        assert asyncio.get_running_loop().time() - began_s < 0.5

    in_cell(scenario)


def trouble_of(cell: RobotCell) -> str | None:
    """Read anew each time: what was asserted of it before says nothing about now."""
    trouble = cell.supervisor.link_trouble
    return None if trouble is None else str(trouble)


def test_why_there_is_no_link_is_known_and_logged_once(caplog: pytest.LogCaptureFixture) -> None:
    async def scenario(cell: RobotCell) -> None:
        assert trouble_of(cell) is None
        await lose_the_link(cell)
        await asyncio.sleep(10.0)
        trouble = trouble_of(cell)
        assert trouble is not None
        assert [trouble in record.message for record in caplog.records].count(True) == 1
        view = robot_view(cell.supervisor, None, Calendar())
        assert view.fault is not None
        assert (view.fault.code, view.fault.detail) == ("robot_offline", trouble)
        await find_the_link(cell)
        assert trouble_of(cell) is None

    in_cell(scenario)
