"""Commands under way: each gets its answer, even if the message that carried it was lost."""

from __future__ import annotations

import asyncio

from drivers.arduino.link.go_back_n import NUMBERS, Numbered, Sender
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import EventKind, Refusal
from drivers.arduino.words import refusal_reason, refusal_words
from drivers.robot import BoardRefusedError, RobotDriverError

Status = messages.Ack | messages.Telemetry


class Commands:
    """Sequenced messages and what the board said to them.

    Call ``hear_event`` or ``hear_status`` with a frame's content before ``hear_ack`` with its ack:
    then a refusal is known before the message counts as handled.
    """

    def __init__(self) -> None:
        self.sender = Sender(messages.WINDOW, messages.RETRANSMIT_MS / 1000)
        self._waiting: dict[int, asyncio.Future[None]] = {}
        self._refused: dict[int, int] = {}
        self._events = 0
        self._in_doubt = False

    def send(self, message: Message) -> asyncio.Future[None]:
        """Queue a message; the future ends when the board has handled it.

        It ends with BoardRefusedError if the board refused.
        """
        answer: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._waiting[self.sender.offer(message)] = answer
        return answer

    def take_due(self, now_s: float) -> list[Numbered]:
        """What must be sent now."""
        return self.sender.take_due(now_s)

    def hear_event(self, number: int, event: messages.Event) -> None:
        """An event has come; its number tells whether others were lost before it."""
        self._in_doubt = self._in_doubt or number != self._events
        self._events = (number + 1) % NUMBERS
        if event.kind == EventKind.REFUSED:
            self._note(event.seq, event.code)

    def hear_status(self, status: Status) -> None:
        """Learn from an acknowledgement or telemetry about events that were lost."""
        lost = (status.events - self._events) % NUMBERS
        if lost == 0:
            return
        self._events = status.events
        self._in_doubt = self._in_doubt or lost > 1
        if status.refusal != Refusal.NONE:
            self._note(status.refused_seq, status.refusal)

    def hear_ack(self, ack: int, now_s: float) -> None:
        """The board expects this number: all before it have been handled."""
        handled = self.sender.acknowledge(ack, now_s)
        for ticket in handled:
            answer = self._waiting.pop(ticket)
            refusal = self._refused.pop(ticket, Refusal.NONE if self._in_doubt else None)
            if answer.done():
                continue
            if refusal is None:
                answer.set_result(None)
            else:
                answer.set_exception(
                    BoardRefusedError(
                        f"Refused: {refusal_words(refusal)}.", refusal_reason(refusal)
                    )
                )
        if handled:
            self._in_doubt = False

    def fail(self, error: RobotDriverError) -> None:
        """The link is gone: whoever waits learns it."""
        for answer in self._waiting.values():
            if not answer.done():
                answer.set_exception(error)
        self._waiting.clear()

    def _note(self, seq: int, refusal: int) -> None:
        oldest = self.sender.acknowledged
        offset = (seq - oldest) % NUMBERS
        if offset < messages.WINDOW:
            self._refused[oldest + offset] = refusal
