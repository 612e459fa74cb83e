"""Who sits at the robot: one person at a time, another one only with consent or afterwards.

The lease (``lease.py``) says what moves the robot at this moment: a job, a jog step, a routine. The
seat says which person commands it. Whoever commands sits down; the seat is free again when its
holder leaves it, or has commanded nothing for a while and the robot rests. Until then somebody else
has to ask, and silence means no.

A motion by hand ends before control changes hands. A job or a routine goes on, and whoever has
control then looks after it. Stops need no seat.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import Literal
from uuid import uuid4

from server.control.errors import (
    ControlHeldError,
    NobodyAsksError,
    NotInControlError,
    RequestPendingError,
)
from server.control.jog import SOMEBODY, Jog
from server.control.listeners import Listeners
from server.control.model import RobotMode
from server.control.supervisor import Supervisor
from server.timing import Calendar

HOLD_S = 60.0
"""Control ends so long after the last command, once the robot rests."""

ANSWER_S = 30.0
"""Who does not answer in this time keeps control."""

Answer = Literal["given", "kept", "unanswered", "withdrawn", "ended"]
"""``ended``: the holder's time was over before there was an answer."""

_MOVING = {RobotMode.MOVING, RobotMode.HOMING, RobotMode.STOPPING}


@dataclass(frozen=True, slots=True)
class Operator:
    """A person who commands the robot, or wants to."""

    id: str
    name: str
    role: str


@dataclass(frozen=True, slots=True)
class Seat:
    """Somebody is in control, until ``ends_at``; None: for as long as the robot is busy."""

    operator: Operator
    since: datetime
    ends_at: datetime | None


@dataclass(frozen=True, slots=True)
class ControlRequest:
    """Somebody asks for control."""

    id: str
    operator: Operator
    asked_at: datetime
    ends_at: datetime


@dataclass(frozen=True, slots=True)
class ControlAnswer:
    """What became of a request, and who had control then."""

    request: ControlRequest
    answer: Answer
    by: Operator
    at: datetime


class ControlSeat:
    """The one seat.

    Args:
        supervisor: Owner of the robot.
        jog: Moves by hand; ends before control changes hands.
        calendar: Dates.
        hold_s: Control ends so long after the last command [s of the event loop].
        answer_s: So long a request waits for its answer [s of the event loop].

    Attributes:
        request: Who asks for control.
        answer: What became of the newest request.
    """

    def __init__(
        self,
        supervisor: Supervisor,
        jog: Jog,
        calendar: Calendar,
        *,
        hold_s: float = HOLD_S,
        answer_s: float = ANSWER_S,
    ) -> None:
        self.request: ControlRequest | None = None
        self.answer: ControlAnswer | None = None
        self._supervisor = supervisor
        self._jog = jog
        self._calendar = calendar
        self._hold_s = hold_s
        self._answer_s = answer_s
        self._seat: Seat | None = None
        self._changing = False
        self._busy = False
        self._end: asyncio.TimerHandle | None = None
        self._silence: asyncio.TimerHandle | None = None
        self._listeners = Listeners()
        self._readers: list[Callable[[ControlAnswer], None]] = []
        supervisor.listen(self._robot_changed)

    @property
    def holder(self) -> Seat | None:
        """Who is in control; None when nobody is."""
        return self._seat

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change."""
        self._listeners.add(listener)

    def listen_to_answers(self, reader: Callable[[ControlAnswer], None]) -> None:
        """Call ``reader`` with what becomes of every request."""
        self._readers.append(reader)

    def command(self, operator: Operator | None, *, by_hand: bool = True) -> None:
        """Somebody is about to command the robot, and sits down if the seat is free.

        Args:
            operator: Who. None: a program, which never sits down and never pushes anybody aside.
            by_hand: No job is begun by time or by an energy manager until this person's control
                ends, or the person begins one: there may be hands in the robot.

        Raises:
            ControlHeldError: somebody else is in control, or control is changing hands.
        """
        seat = self._seat
        if self._changing or (seat is not None and seat.operator.id != _id(operator)):
            raise self._held()
        if operator is not None:
            self._sit(operator)
            self._supervisor.reserved_for = operator.name if by_hand else None

    def ask(self, operator: Operator) -> None:
        """Ask for control; a free seat is taken at once.

        Raises:
            RequestPendingError: somebody else has asked before.
            ControlHeldError: control is changing hands at this moment.
        """
        if self._changing:
            raise self._held()
        if self._seat is None or self._seat.operator.id == operator.id:
            self._sit(operator)
            return
        if self.request is not None:
            if self.request.operator.id == operator.id:
                return
            raise RequestPendingError(f"{self.request.operator.name} has asked already.")
        now = self._calendar.now()
        self.request = ControlRequest(str(uuid4()), operator, now, self._in(self._answer_s))
        self._silence = asyncio.get_running_loop().call_later(
            self._answer_s, self._settle, "unanswered"
        )
        self._listeners.tell()

    def withdraw(self, operator: Operator) -> None:
        """Ask no more; harmless for whoever does not ask."""
        if self.request is not None and self.request.operator.id == operator.id:
            self._settle("withdrawn")

    async def reply(self, operator: Operator, request_id: str, *, give: bool) -> None:
        """Give control to whoever asks, or keep it.

        Raises:
            NotInControlError: control is not this person's to give.
            NobodyAsksError: the request was withdrawn, or its time is over.
        """
        self._require_holder(operator)
        request = self.request
        if request is None or request.id != request_id:
            raise NobodyAsksError("Nobody waits for this answer any more.")
        if give:
            await self._hand_over(request.operator)
        else:
            self._settle("kept")
            self._sit(operator)

    async def leave(self, operator: Operator) -> None:
        """Give control back; whoever has asked for it gets it.

        Raises:
            NotInControlError: control is not this person's to give.
        """
        self._require_holder(operator)
        await self._hand_over(self.request.operator if self.request is not None else None)

    # Inside

    async def _hand_over(self, operator: Operator | None) -> None:
        """Nothing may be commanded by anybody before what moves by hand has come to rest."""
        if operator is not None:
            self._settle("given")
        self._changing = True
        try:
            await self._jog.break_off("Control of the robot changes hands.")
        finally:
            self._changing = False
            self._stand_up()
            if operator is not None:
                self._sit(operator)
            self._listeners.tell()

    def _sit(self, operator: Operator) -> None:
        seat = self._seat
        since = self._calendar.now()
        if seat is not None and seat.operator.id == operator.id:
            since = seat.since
        self._seat = Seat(operator, since, None)
        self._jog.operator = operator.name
        self._busy = self._is_busy()
        self._renew()

    def _renew(self) -> None:
        """Count the time to the end anew; it stands still while the robot is busy."""
        if self._end is not None:
            self._end.cancel()
            self._end = None
        seat = self._seat
        if seat is None:
            return
        ends_at = None
        if not self._busy:
            self._end = asyncio.get_running_loop().call_later(self._hold_s, self._lapse)
            ends_at = self._in(self._hold_s)
        self._seat = Seat(seat.operator, seat.since, ends_at)
        self._listeners.tell()

    def _lapse(self) -> None:
        request = self.request
        self._settle("ended")
        self._stand_up()
        if request is not None:
            self._sit(request.operator)
        self._listeners.tell()

    def _stand_up(self) -> None:
        if self._end is not None:
            self._end.cancel()
            self._end = None
        self._seat = None
        self._jog.operator = SOMEBODY
        self._supervisor.reserved_for = None

    def _settle(self, answer: Answer) -> None:
        if self._silence is not None:
            self._silence.cancel()
            self._silence = None
        request, seat = self.request, self._seat
        if request is None or seat is None:
            return
        self.request = None
        self.answer = ControlAnswer(request, answer, seat.operator, self._calendar.now())
        for reader in self._readers:
            reader(self.answer)
        self._listeners.tell()

    def _robot_changed(self) -> None:
        if self._seat is not None and not self._changing and self._is_busy() is not self._busy:
            self._busy = not self._busy
            self._renew()

    def _is_busy(self) -> bool:
        """It moves, or something other than a job is under way: a job may rest for hours."""
        lease = self._supervisor.holder
        by_hand = lease is not None and lease.kind != "job"
        return by_hand or self._supervisor.mode in _MOVING

    def _require_holder(self, operator: Operator) -> None:
        if self._changing or self._seat is None or self._seat.operator.id != operator.id:
            raise NotInControlError("You are not in control of the robot.")

    def _held(self) -> ControlHeldError:
        seat = self._seat
        name = seat.operator.name if seat is not None else "Somebody else"
        return ControlHeldError(f"{name} is in control of the robot.", holder=name)

    def _in(self, delay_s: float) -> datetime:
        return self._calendar.at(asyncio.get_running_loop().time() + delay_s)


def _id(operator: Operator | None) -> str | None:
    return None if operator is None else operator.id
