"""Watchdogs, and how the stops that they bring about come to an end."""

from __future__ import annotations

import asyncio

import pytest

from drivers.robot import RobotState
from server.config.supervision import SupervisionSettings
from server.control.errors import (
    ReleaseRefusedError,
    RobotStoppedError,
    TelemetryStaleError,
)
from server.control.model import PlugState, RobotMode
from server.control.plug_guard import Corridor, PlugRecord
from tests.support.robot_cell import MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import wait_until
from twin.joints import JointPosition

IMPATIENT = SupervisionSettings(telemetry_age_s=0.2)
"""The board's own watch over its queue and its heartbeat would come first otherwise."""

FAR = JointPosition(300.0, 60.0, 50.0)


def make_deaf(cell: RobotCell, *, deaf: bool = True) -> None:
    """The link lives, but no telemetry comes through."""
    feed = cell.garage.robot._feed
    if deaf:
        feed.publish = lambda _: None  # type: ignore[method-assign]
    else:
        del feed.publish  # type: ignore[attr-defined]


async def a_motion(cell: RobotCell) -> asyncio.Task[RobotState]:
    async def go() -> RobotState:
        async with cell.supervisor.control("job", "Plug-in job") as lease:
            return await cell.supervisor.move_joints(lease, FAR)

    task = asyncio.create_task(go())
    await asyncio.sleep(0.8)
    assert cell.moving()
    return task


async def deaf_while_moving(cell: RobotCell) -> asyncio.Task[RobotState]:
    task = await a_motion(cell)
    make_deaf(cell)
    began_s = asyncio.get_running_loop().time()
    await wait_until(lambda: cell.supervisor.stop_cause is not None, 1.0)
    assert asyncio.get_running_loop().time() - began_s < 0.22
    await wait_until(lambda: not cell.moving(), 0.2)
    return task


def test_old_news_of_a_moving_robot_stop_it_and_are_named() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await deaf_while_moving(cell)
        make_deaf(cell, deaf=False)
        with pytest.raises(TelemetryStaleError, match="ms old"):
            await task
        assert cell.mode() is RobotMode.STOPPED
        assert cell.robot.enabled, "category 2 keeps the drives on"
        async with cell.supervisor.control("job", "Test") as lease:
            with pytest.raises(TelemetryStaleError):
                await cell.supervisor.move_joints(lease, FAR)

    in_cell(scenario, settings=IMPATIENT)


def test_a_resting_robot_may_be_silent_for_a_tenth_of_a_second() -> None:
    async def scenario(cell: RobotCell) -> None:
        await asyncio.sleep(10.0)
        assert cell.supervisor.stop_cause is None

    in_cell(scenario, settings=IMPATIENT)


def test_a_watchdogs_stop_ends_by_itself_with_a_free_plug_and_nothing_moves() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await deaf_while_moving(cell)
        await asyncio.sleep(10.0)
        assert cell.supervisor.stop_cause is not None, "its cause is still there"
        make_deaf(cell, deaf=False)
        await asyncio.gather(task, return_exceptions=True)
        here = cell.now
        await asyncio.sleep(2.5)
        assert cell.mode() is RobotMode.STOPPED
        await asyncio.sleep(1.5)
        assert cell.mode() is RobotMode.READY
        await asyncio.sleep(2.0)
        assert cell.now == here

    in_cell(scenario, settings=IMPATIENT)


def test_a_watchdogs_stop_with_the_plug_in_waits_for_a_person() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def pull() -> None:
            supervisor = cell.supervisor
            async with supervisor.control("job", "Test") as lease, supervisor.plug_may_move():
                await supervisor.move_joints(lease, inside._replace(rho3_mm=60.0))

        task = asyncio.create_task(pull())
        await asyncio.sleep(1.5)
        assert cell.moving()
        make_deaf(cell)
        await wait_until(lambda: cell.supervisor.stop_cause is not None, 1.0)
        make_deaf(cell, deaf=False)
        with pytest.raises(TelemetryStaleError):
            await task
        await asyncio.sleep(60.0)
        assert cell.mode() is RobotMode.STOPPED
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.READY
        assert cell.plug() is PlugState.INSERTED

    inside = JointPosition(150.0, 150.0, 110.0)
    record = PlugRecord(PlugState.INSERTED, Corridor(150.0, 150.0, 55.0, 75.0, 115.0))
    in_cell(scenario, parameters(start_joints=inside), store=MemoryPlug(record), settings=IMPATIENT)


def test_what_a_person_pressed_ends_only_by_a_person() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await deaf_while_moving(cell)
        make_deaf(cell, deaf=False)
        await cell.supervisor.stop()
        await asyncio.gather(task, return_exceptions=True)
        await asyncio.sleep(60.0)
        cause = cell.supervisor.stop_cause
        assert cause is not None
        assert cause.by_person
        async with cell.supervisor.control("job", "Test") as lease:
            with pytest.raises(RobotStoppedError, match="Somebody pressed stop"):
                await cell.supervisor.move_joints(lease, FAR)
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.READY

    in_cell(scenario, settings=IMPATIENT)


def test_a_release_waits_for_rest_and_names_what_is_missing() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await a_motion(cell)
        await cell.supervisor.stop()
        await cell.supervisor.reset()
        assert not cell.moving(), "it was released before it stood still"
        await asyncio.gather(task, return_exceptions=True)
        assert [one.code for one in cell.supervisor.release_conditions if one.met] == [
            "link",
            "fresh",
            "standstill",
        ]
        await cell.supervisor.stop()
        make_deaf(cell)
        await asyncio.sleep(1.0)
        with pytest.raises(ReleaseRefusedError, match="ms old") as refusal:
            await cell.supervisor.reset()
        assert refusal.value.context["missing"] == ["fresh"]
        assert cell.mode() is RobotMode.STOPPED

    in_cell(scenario, settings=IMPATIENT)


def test_a_stopped_robot_that_is_pushed_away_loses_its_power() -> None:
    async def scenario(cell: RobotCell) -> None:
        await cell.supervisor.stop()
        await asyncio.sleep(0.5)
        world, robot = cell.garage.world, cell.garage.robot
        at = cell.robot.commanded.position
        world.drive_to(at._replace(rho3_mm=at.rho3_mm + 3.0), robot._now())
        robot._wake.set()
        await wait_until(lambda: cell.mode() is RobotMode.EMERGENCY_STOP, 1.0)
        await wait_until(lambda: not cell.robot.enabled, 1.0)

    in_cell(scenario, settings=IMPATIENT)
