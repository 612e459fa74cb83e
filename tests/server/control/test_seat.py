"""One person commands the robot; another one does with consent, or after that."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

import pytest

from server.control.errors import (
    ControlHeldError,
    ControlLostError,
    NobodyAsksError,
    NotInControlError,
    RequestPendingError,
)
from server.control.seat import ANSWER_S, HOLD_S, ControlSeat, Operator
from server.timing import Calendar
from tests.support.robot_cell import RobotCell, in_cell, parameters
from twin.joints import JointPosition

ANNA = Operator("1", "Anna", "technician")
BEN = Operator("2", "Ben", "resident")
CARA = Operator("3", "Cara", "owner")
MIDDLE = JointPosition(200.0, 180.0, 80.0)

Scenario = Callable[[RobotCell, ControlSeat], Awaitable[None]]


def with_seat(scenario: Scenario) -> None:
    async def main(cell: RobotCell) -> None:
        await scenario(cell, ControlSeat(cell.supervisor, cell.jog, Calendar()))

    in_cell(main, parameters(start_joints=MIDDLE))


def holder(seat: ControlSeat) -> str | None:
    return seat.holder.operator.name if seat.holder is not None else None


def asked(seat: ControlSeat) -> str:
    assert seat.request is not None
    return seat.request.id


def test_whoever_commands_is_in_control_until_nothing_was_commanded_for_long() -> None:
    async def scenario(_: RobotCell, seat: ControlSeat) -> None:
        seat.command(ANNA)
        await asyncio.sleep(0.75 * HOLD_S)
        seat.command(ANNA)
        await asyncio.sleep(0.75 * HOLD_S)
        for other in (BEN, None):
            with pytest.raises(ControlHeldError, match="Anna"):
                seat.command(other)
        await asyncio.sleep(0.26 * HOLD_S)
        seat.command(None)
        assert holder(seat) is None, "a program commands, and sits nowhere"
        seat.command(BEN)
        assert holder(seat) == "Ben"

    with_seat(scenario)


def test_control_never_ends_by_time_while_the_robot_moves_or_is_calibrated() -> None:
    async def scenario(cell: RobotCell, seat: ControlSeat) -> None:
        seat.command(ANNA)
        async with cell.supervisor.control("calibration", "Calibration"):
            await asyncio.sleep(2 * HOLD_S)
            assert seat.holder is not None
            assert seat.holder.ends_at is None
        async with cell.supervisor.control("job", "Charging job"):
            await asyncio.sleep(HOLD_S + 0.1)
            assert holder(seat) is None, "a job may rest for hours"

    with_seat(scenario)


def test_a_held_motion_ends_before_control_is_given() -> None:
    async def scenario(cell: RobotCell, seat: ControlSeat) -> None:
        for _ in range(5):
            seat.command(ANNA)
            cell.jog.hold("x", 1, 40.0)
            await asyncio.sleep(0.1)
        seat.ask(BEN)
        assert cell.moving()
        giving = asyncio.create_task(seat.reply(ANNA, asked(seat), give=True))
        while holder(seat) == "Anna":
            for person in (ANNA, BEN):
                if holder(seat) == "Anna" and not giving.done() and seat.request is None:
                    with pytest.raises(ControlHeldError):
                        seat.command(person)
            await asyncio.sleep(0.001)
        assert holder(seat) == "Ben"
        assert not cell.moving()
        assert cell.holder() is None
        await giving
        with pytest.raises(ControlHeldError, match="Ben"):
            seat.command(ANNA)
        seat.command(BEN)
        await cell.jog.step("x", -1.0, 20.0)

    with_seat(scenario)


def test_a_step_is_broken_off_and_its_sender_told() -> None:
    async def scenario(cell: RobotCell, seat: ControlSeat) -> None:
        seat.command(ANNA)
        step = asyncio.create_task(cell.jog.step("y", -40.0, 10.0))
        await asyncio.sleep(1.0)
        seat.ask(BEN)
        await seat.leave(ANNA)
        assert holder(seat) == "Ben"
        assert not cell.moving()
        with pytest.raises(ControlLostError, match="changes hands"):
            await step

    with_seat(scenario)


def test_a_job_goes_on_when_control_changes_hands() -> None:
    async def scenario(cell: RobotCell, seat: ControlSeat) -> None:
        seat.command(ANNA)
        async with cell.supervisor.control("job", "Charging job") as lease:
            away = JointPosition(210.0, 190.0, 80.0)
            going = asyncio.create_task(cell.supervisor.move_joints(lease, away))
            await asyncio.sleep(0.2)
            seat.ask(BEN)
            await seat.reply(ANNA, asked(seat), give=True)
            assert holder(seat) == "Ben"
            assert cell.moving()
            await going
            lease.require()

    with_seat(scenario)


def test_silence_means_no() -> None:
    async def scenario(_: RobotCell, seat: ControlSeat) -> None:
        told: list[str] = []
        seat.listen_to_answers(lambda answer: told.append(answer.answer))
        seat.command(ANNA)
        seat.ask(BEN)
        request_id = asked(seat)
        seat.ask(BEN)
        assert asked(seat) == request_id, "asking twice is asking once"
        with pytest.raises(RequestPendingError, match="Ben"):
            seat.ask(CARA)
        with pytest.raises(NotInControlError):
            await seat.reply(BEN, request_id, give=True)
        await asyncio.sleep(ANSWER_S + 0.1)
        assert seat.request is None
        assert holder(seat) == "Anna"
        with pytest.raises(NobodyAsksError):
            await seat.reply(ANNA, request_id, give=True)
        seat.ask(CARA)
        await seat.reply(ANNA, asked(seat), give=False)
        seat.ask(BEN)
        seat.withdraw(CARA)
        seat.withdraw(BEN)
        assert holder(seat) == "Anna"
        assert told == ["unanswered", "kept", "withdrawn"]

    with_seat(scenario)


def test_whoever_asks_gets_what_is_left_or_ends() -> None:
    async def scenario(_: RobotCell, seat: ControlSeat) -> None:
        seat.ask(ANNA)
        assert holder(seat) == "Anna", "a free seat is taken at once"
        await asyncio.sleep(HOLD_S - 1.0)
        seat.ask(BEN)
        await asyncio.sleep(1.1)
        assert holder(seat) == "Ben"
        assert seat.answer is not None
        assert seat.answer.answer == "ended"
        await seat.leave(BEN)
        assert holder(seat) is None

    with_seat(scenario)
