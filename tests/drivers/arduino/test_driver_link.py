"""The driver's link: connecting, losing messages, losing the board."""

from __future__ import annotations

import asyncio
import contextlib
from pathlib import Path

import pytest

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.errors import BoardNotFoundError, LinkLostError
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import Refusal
from drivers.arduino.settings import BoardSettings
from drivers.robot import (
    BoardRefusedError,
    BoardState,
    NotConnectedError,
    StopCategory,
)
from tests.drivers.arduino.driving import (
    GEOMETRY,
    HOME,
    LIMITS,
    WITHIN_S,
    robot_at,
    until,
)
from tests.support.board_cable import BoardCable, board_cable
from tests.support.eventually import eventually
from tests.support.fake_board import FakeBoard
from twin.joints import JointPosition
from twin.motion import plan_joint_move, plan_segments


async def test_a_second_connection_does_not_configure_again(cable: BoardCable) -> None:
    for _ in range(2):
        robot = robot_at(cable)
        await robot.connect()
        await robot.close()
    commits = [m for m in cable.board.heard if isinstance(m, messages.ConfigCommit)]
    assert len(commits) == 1


async def test_a_bad_line_changes_nothing(tmp_path: Path) -> None:
    with board_cable(tmp_path, loss=0.08) as cable:
        robot = robot_at(cable)
        await robot.connect()
        await robot.enable()
        await robot.home()
        for force_n in range(10, 40):
            await robot.set_force_limit(float(force_n))
            assert cable.board.force_limit_dn == 10 * force_n
        limits = [m for m in cable.board.heard if isinstance(m, messages.ForceLimit)]
        assert [m.force_dn for m in limits] == [10 * n for n in range(10, 40)]
        await robot.stop(StopCategory.DECELERATE_AND_HOLD)
        await robot.close()
        assert cable.board.state is messages.State.IDLE


async def test_a_refusal_is_noticed_although_its_event_was_lost(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    def refuse_secretly(board: FakeBoard) -> None:
        board.refuse_next = Refusal.BAD_VALUE
        board.events_to_lose = 1

    cable.change(refuse_secretly)
    with pytest.raises(BoardRefusedError, match="outside its range"):
        await homed.set_force_limit(50.0)
    await homed.set_force_limit(60.0)


async def test_a_pulled_cable_ends_the_telemetry(homed: ArduinoRobot, cable: BoardCable) -> None:
    reader = homed.telemetry()
    cable.pull()
    async with asyncio.timeout(WITHIN_S):
        async for _ in reader:
            pass
    with pytest.raises(NotConnectedError):
        await homed.stop(StopCategory.DECELERATE_AND_HOLD)
    with pytest.raises(BoardNotFoundError, match="cannot be opened"):
        await homed.connect()
    cable.change(lambda board: board.restart())  # it lived on the power of the cable
    cable.plug_in()
    await homed.connect()
    state = await until(homed, lambda _: True)
    assert not state.homed
    assert state.board is BoardState.IDLE


async def test_a_silent_board_is_a_lost_one(homed: ArduinoRobot, cable: BoardCable) -> None:
    reader = homed.telemetry()
    command = asyncio.create_task(homed.home())
    cable.change(lambda board: setattr(board, "mute", True))
    async with asyncio.timeout(WITHIN_S):
        async for _ in reader:
            pass
    with pytest.raises(NotConnectedError):
        await command


async def test_a_link_that_breaks_right_behind_the_answer_ends_the_homing(
    homed: ArduinoRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    connection = homed._connection
    assert connection is not None
    answered = connection.home

    async def home() -> None:
        await answered()
        homed._lose(LinkLostError("The cable was pulled."))

    monkeypatch.setattr(connection, "home", home)
    async with asyncio.timeout(WITHIN_S):
        with pytest.raises(NotConnectedError):
            await homed.home()


async def test_a_board_that_restarts_is_a_lost_one(homed: ArduinoRobot, cable: BoardCable) -> None:
    reader = homed.telemetry()
    cable.change(lambda board: board.restart())
    async with asyncio.timeout(WITHIN_S):
        async for _ in reader:
            pass
    await homed.connect()
    assert not (await until(homed, lambda _: True)).homed


async def test_a_host_that_falls_silent_stops_the_board(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    assert homed._connection is not None
    homed._connection.session.end(NotConnectedError("the host hangs"))
    await eventually(lambda: cable.board.fault is messages.Fault.HEARTBEAT_LOST)
    assert not cable.board.enabled


async def test_heartbeats_keep_the_drives_on(homed: ArduinoRobot) -> None:
    loop = asyncio.get_running_loop()
    end_s = loop.time() + 2.5 * messages.HEARTBEAT_TIMEOUT_MS / 1000
    state = await until(homed, lambda s: s.received_at_s > end_s)
    assert state.enabled
    assert state.fault is None


async def test_without_a_link_every_command_says_so(tmp_path: Path) -> None:
    robot = ArduinoRobot(str(tmp_path / "nothing"), GEOMETRY, LIMITS, BoardSettings())
    with pytest.raises(BoardNotFoundError):
        await robot.connect()
    with pytest.raises(NotConnectedError):
        await robot.enable()
    with pytest.raises(NotConnectedError):
        robot.telemetry()
    await robot.close()
    await robot.close()


async def test_closing_stops_and_releases(homed: ArduinoRobot, cable: BoardCable) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(180, 170, 55))
    await homed.push(plan_segments(plan, 0.02)[:12])
    reader = homed.telemetry()
    await homed.close()
    with contextlib.suppress(StopAsyncIteration):
        while True:
            await anext(reader)
    assert cable.board.state is messages.State.IDLE
    assert cable.board.fault is messages.Fault.NONE
