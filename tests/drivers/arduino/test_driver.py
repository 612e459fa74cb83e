"""The driver against a board that speaks the real protocol over a pseudo terminal."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable, Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from drivers.arduino import handshake
from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.errors import BoardNotFoundError, BoardSilentError, WrongFirmwareError
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import Refusal
from drivers.arduino.settings import BoardSettings
from drivers.robot import (
    BoardRefusedError,
    BoardState,
    FaultCode,
    NotConnectedError,
    QueueFullError,
    RobotState,
    StopCategory,
)
from tests.support.board_cable import BoardCable, board_cable
from tests.support.eventually import eventually
from tests.support.fake_board import FakeBoard
from twin.geometry import RobotGeometry
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion import MotionLimits, Segment, plan_joint_move, plan_segments

GEOMETRY = RobotGeometry()
LIMITS = MotionLimits()
WITHIN_S = 5.0
HOME = JointPosition(150, 150, 50)
STILL = Segment(0.02, HOME, JointVelocity(0, 0, 0), JointAcceleration(0, 0, 0))


@pytest.fixture
def cable(tmp_path: Path) -> Iterator[BoardCable]:
    with board_cable(tmp_path) as cable:
        yield cable


def robot_at(cable: BoardCable) -> ArduinoRobot:
    return ArduinoRobot(str(cable.device), GEOMETRY, LIMITS, BoardSettings())


@pytest.fixture
async def robot(cable: BoardCable) -> AsyncIterator[ArduinoRobot]:
    robot = robot_at(cable)
    await robot.connect()
    yield robot
    await robot.close()


@pytest.fixture
async def homed(robot: ArduinoRobot) -> ArduinoRobot:
    await robot.enable()
    await robot.home()
    return robot


async def until(robot: ArduinoRobot, condition: Callable[[RobotState], bool]) -> RobotState:
    async with asyncio.timeout(WITHIN_S):
        async for state in robot.telemetry():
            if condition(state):
                return state
    raise AssertionError("the telemetry ended")


async def move(robot: ArduinoRobot, target: JointPosition) -> list[RobotState]:
    """Feed a whole move as the server does, and return all samples on the way."""
    start = (await until(robot, lambda s: s.board is BoardState.READY)).commanded.position
    pending = plan_segments(plan_joint_move(LIMITS, start, target), 0.02)
    samples: list[RobotState] = []
    reader = robot.telemetry()
    await robot.push(pending[:8])
    del pending[:8]
    pushed_s = asyncio.get_running_loop().time()
    async with asyncio.timeout(WITHIN_S):
        async for state in reader:
            samples.append(state)
            if state.fault is not None:
                return samples
            room = min(state.queue_free - 8, len(pending))
            if room > 0 and state.sampled_at_s > pushed_s:
                await robot.push(pending[:room])
                del pending[:room]
                pushed_s = asyncio.get_running_loop().time()
            ended = state.board is BoardState.READY and state.sampled_at_s > pushed_s
            if ended and not pending:
                return samples
    raise AssertionError("the telemetry ended")


async def test_a_board_introduces_itself(robot: ArduinoRobot, cable: BoardCable) -> None:
    identity = await robot.connect()  # again: nothing happens
    assert identity.name == "Me Auriga"
    assert identity.firmware == "1.2.3"
    assert identity.queue_capacity == 16
    assert identity.segment_s == pytest.approx(0.02)
    assert cable.board.state is messages.State.IDLE, "it was configured"


async def test_a_second_connection_does_not_configure_again(cable: BoardCable) -> None:
    for _ in range(2):
        robot = robot_at(cable)
        await robot.connect()
        await robot.close()
    commits = [m for m in cable.board.heard if isinstance(m, messages.ConfigCommit)]
    assert len(commits) == 1


async def test_homing_gives_valid_positions(robot: ArduinoRobot) -> None:
    assert not (await until(robot, lambda _: True)).homed
    await robot.enable()
    await robot.home()
    state = await until(robot, lambda _: True)
    assert state.homed
    assert state.enabled
    assert state.board is BoardState.READY
    assert state.measured.position == pytest.approx((150.0, 150.0, 50.0), abs=0.02)
    assert state.force_n == pytest.approx(12.3)


async def test_a_motion_ends_exactly_where_it_should(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    target = JointPosition(161.2345, 141.5, 52.25)
    samples = await move(homed, target)
    assert samples[-1].commanded.position == pytest.approx(target, abs=1e-6)
    assert samples[-1].fault is None
    scale = BoardSettings().rho1.units_per_mm
    assert cable.board.queue.position[0] / 2**31 / scale == pytest.approx(161.2345, abs=1e-6)
    moving = [s for s in samples if s.board is BoardState.RUN]
    assert len(moving) > 20
    fastest = max(s.commanded.velocity.rho1_mm_s for s in moving)
    assert 20 < fastest <= 80
    times = [s.sampled_at_s for s in samples]
    assert all(b > a for a, b in pairwise(times))
    assert all(0 <= s.received_at_s - s.sampled_at_s < 0.1 for s in samples)


async def test_several_motions_one_after_another(homed: ArduinoRobot) -> None:
    for target in (JointPosition(152, 149, 50), JointPosition(150, 150, 51.234)):
        samples = await move(homed, target)
        assert samples[-1].commanded.position == pytest.approx(target, abs=1e-6)


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


async def test_the_board_knows_better_and_says_why(robot: ArduinoRobot, cable: BoardCable) -> None:
    with pytest.raises(BoardRefusedError, match="the drives are off"):
        await robot.home()
    # positions that are allowed, but not known to be true
    cable.change(lambda board: board.queue.place((33988, 33988, 4650)))
    await robot.enable()
    await until(robot, lambda state: state.enabled)
    with pytest.raises(BoardRefusedError, match="before homing"):
        await robot.push([STILL])


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


@pytest.mark.parametrize(
    ("segment", "why"),
    [
        (Segment(0.02, JointPosition(151, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, 0)), "rho1 jumps"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 9, 0),
                 JointAcceleration(0, 0, 0)), "velocity of rho2 jumps"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, -200)), "rho3 would go to"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(5000, 0, 0)), "would move at"),
        (Segment(0.5, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, 0)), "it lasts"),
    ],
)  # fmt: skip
async def test_segments_that_the_board_cannot_follow_do_not_reach_it(
    homed: ArduinoRobot, cable: BoardCable, segment: Segment, why: str
) -> None:
    with pytest.raises(BoardRefusedError, match=why):
        await homed.push([segment])
    assert not [m for m in cable.board.heard if isinstance(m, messages.Segment)]
    assert len(await move(homed, JointPosition(150.5, 150, 50))) > 2, "it still works"


async def test_a_full_queue_takes_nothing(homed: ArduinoRobot, cable: BoardCable) -> None:
    with pytest.raises(QueueFullError):
        await homed.push([STILL] * 17)
    assert not [m for m in cable.board.heard if isinstance(m, messages.Segment)]
    await homed.push([STILL] * 16)


async def test_after_a_stop_the_robot_goes_on_from_where_it_stands(homed: ArduinoRobot) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(180, 170, 55))
    await homed.push(plan_segments(plan, 0.02)[:12])
    await until(homed, lambda s: s.commanded.velocity.rho1_mm_s > 10)
    await homed.stop(StopCategory.DECELERATE_AND_HOLD)
    state = await until(homed, lambda s: s.board is BoardState.READY)
    assert state.enabled
    assert 150.1 < state.commanded.position.rho1_mm < 180
    samples = await move(homed, JointPosition(150, 150, 50))
    assert samples[-1].commanded.position == pytest.approx((150, 150, 50), abs=1e-6)


async def test_stops_release_or_hold(homed: ArduinoRobot) -> None:
    await homed.stop(StopCategory.DECELERATE_AND_HOLD)
    assert (await until(homed, lambda _: True)).enabled
    await homed.stop(StopCategory.DECELERATE_AND_RELEASE)
    state = await until(homed, lambda s: not s.enabled)
    assert state.board is BoardState.IDLE


async def test_an_emergency_stop_stays_until_it_is_cleared(homed: ArduinoRobot) -> None:
    await homed.emergency_stop()
    state = await until(homed, lambda s: s.fault is not None)
    assert state.board is BoardState.FAULT
    assert state.fault is not None
    assert state.fault.code is FaultCode.EMERGENCY_STOP
    with pytest.raises(BoardRefusedError, match="a fault is latched"):
        await homed.enable()
    await homed.clear_fault()
    assert (await until(homed, lambda s: s.fault is None)).board is BoardState.IDLE


async def test_a_queue_that_runs_empty_is_a_fault(homed: ArduinoRobot) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(180, 170, 55))
    await homed.push(plan_segments(plan, 0.02)[:6])
    state = await until(homed, lambda s: s.fault is not None)
    assert state.fault is not None
    assert state.fault.code is FaultCode.QUEUE_UNDERRUN


async def test_a_single_lost_step_is_a_segment_mismatch(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(158, 156, 51))
    await homed.push(plan_segments(plan, 0.02)[:14])
    cable.change(lambda board: board.queue.slip((0, -1, 0)))
    state = await until(homed, lambda s: s.fault is not None)
    assert state.fault is not None
    assert state.fault.code is FaultCode.SEGMENT_MISMATCH
    assert not state.homed


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


async def test_the_firmware_of_another_version_is_named(tmp_path: Path) -> None:
    with (
        board_cable(tmp_path, protocol_hash=0x1234ABCD) as cable,
        pytest.raises(WrongFirmwareError, match=r"firmware 1\.2\.3 .*1234ABCD.*Flash"),
    ):
        await robot_at(cable).connect()


async def test_a_port_where_nothing_answers(
    cable: BoardCable, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(handshake, "BOOT_S", 0.05)
    monkeypatch.setattr(handshake, "ANSWER_S", 0.2)
    cable.change(lambda board: setattr(board, "mute", True))
    with pytest.raises(BoardSilentError, match="no motion board answers"):
        await robot_at(cable).connect()


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
