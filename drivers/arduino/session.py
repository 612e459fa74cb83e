"""One session with a board: from the open port to its loss, without any meaning of motion."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable
from typing import Protocol

from drivers.arduino.commands import Commands
from drivers.arduino.errors import LinkLostError
from drivers.arduino.link.clock import BoardClock
from drivers.arduino.link.frames import Frame, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.robot import NotConnectedError

SILENCE_S = 0.3
"""A board that says nothing for so long is gone."""

STOP_REPEAT_S = messages.RETRANSMIT_MS / 1000

CLOCK_PERIOD_S = 1.0
CLOCK_FIRST_PERIOD_S = 0.02
CLOCK_FIRST_QUESTIONS = 8
"""At first the clock is asked quickly, so that the telemetry has good times at once."""

TOKENS = 256


class Port(Protocol):
    """Where bytes go."""

    def write(self, data: bytes) -> None:
        """Send bytes; returns at once."""
        ...


class Session:
    """Carries commands, keeps the board's watchdog quiet and its clock in view.

    Args:
        port: Where frames go.
        on_sample: Gets telemetry and when it was received.
        on_lost: Called once when the session has ended by itself.

    Attributes:
        clock: Of the board, on the host's clock.
        received: Frames of the board since the session began.
    """

    def __init__(
        self,
        port: Port,
        on_sample: Callable[[messages.Telemetry, float], None],
        on_lost: Callable[[LinkLostError], None],
    ) -> None:
        self.clock = BoardClock(messages.TICK_HZ)
        self.received = 0
        self._loop = asyncio.get_running_loop()
        self._port = port
        self._on_sample = on_sample
        self._on_lost = on_lost
        self._commands = Commands()
        self._heard_s = self._loop.time()
        self._stop_token = 0
        self._unheard_stops: dict[int, asyncio.Event] = {}
        self._questions: dict[int, float] = {}
        self._asked = 0
        self._error: NotConnectedError | None = None
        self._retransmission: asyncio.TimerHandle | None = None
        self._tasks = [
            asyncio.create_task(self._keep_alive(), name="board heartbeat"),
            asyncio.create_task(self._ask_time(), name="board clock"),
        ]

    @property
    def sent_again(self) -> int:
        """Messages that were sent more than once because no acknowledgement came."""
        return self._commands.sender.sent_again

    # --- what the driver does ----------------------------------------------------------------

    def require(self) -> None:
        """Do nothing while the session lives.

        Raises:
            NotConnectedError: it has ended, and why.
        """
        if self._error is not None:
            raise self._error

    async def command(self, *commands: Message) -> None:
        """Send sequenced messages and wait until the board has handled all of them.

        Once sent they take effect even if the caller is cancelled.

        Raises:
            BoardRefusedError: the board refused at least one; the first is told.
            NotConnectedError: the link broke before it had handled them.
        """
        self.require()
        answers = [self._commands.send(command) for command in commands]
        self._pump()
        results = await asyncio.gather(*answers, return_exceptions=True)
        for result in results:
            if isinstance(result, BaseException):
                raise result

    async def stop(self, make: Callable[[int], Message]) -> None:
        """Send a stop until the board says that it has heard it.

        Args:
            make: Makes the message for a token.

        Raises:
            NotConnectedError: the link broke before.
        """
        self.require()
        self._stop_token = token = self._stop_token % (TOKENS - 1) + 1  # never 0
        heard = self._unheard_stops[token] = asyncio.Event()
        try:
            while not heard.is_set():
                self._write(make(token))
                with contextlib.suppress(TimeoutError):
                    async with asyncio.timeout(STOP_REPEAT_S):
                        await heard.wait()
        finally:
            del self._unheard_stops[token]
        self.require()

    def end(self, error: NotConnectedError) -> None:
        """End the session; whoever waits for an answer gets the error. Safe to call twice."""
        if self._error is not None:
            return
        self._error = error
        for task in self._tasks:
            task.cancel()
        if self._retransmission is not None:
            self._retransmission.cancel()
        self._commands.fail(error)
        for heard in self._unheard_stops.values():
            heard.set()

    # --- what the board says -----------------------------------------------------------------

    def hear(self, frame: Frame, received_s: float) -> None:
        """Take a frame of the board."""
        if self._error is not None:
            return
        self._heard_s = received_s
        self.received += 1
        message = frame.message
        match message:
            case messages.Hello(session=0):
                self.lose("The board has restarted.")
                return
            case messages.Event():
                self._commands.hear_event(frame.seq, message)
            case messages.ClockReply():
                asked_s = self._questions.pop(message.token, None)
                if asked_s is not None:
                    self.clock.add_answer(asked_s, received_s, message.tick)
            case messages.Ack() | messages.Telemetry():
                self._commands.hear_status(message)
                if message.stop_token in self._unheard_stops:
                    self._unheard_stops[message.stop_token].set()
        self._commands.hear_ack(frame.ack, self._loop.time())
        self._pump()
        if isinstance(message, messages.Telemetry):
            self._on_sample(message, received_s)

    def lose(self, words: str) -> None:
        """The link broke."""
        if self._error is None:
            error = LinkLostError(words)
            self.end(error)
            self._on_lost(error)

    # --- inside ------------------------------------------------------------------------------

    def _pump(self) -> None:
        """Send what is due and come back when it is overdue."""
        if self._error is not None:
            return
        due = self._commands.take_due(self._loop.time())
        if due:
            # a delimiter first: line noise before it does not cost the first frame
            self._port.write(
                b"\0" + b"".join(encode_frame(Frame(item.seq, 0, item.message)) for item in due)
            )
        overdue_s = self._commands.sender.overdue_s
        if self._retransmission is not None:
            self._retransmission.cancel()
        self._retransmission = (
            None if overdue_s is None else self._loop.call_at(overdue_s, self._pump)
        )

    def _write(self, message: Message) -> None:
        self._port.write(b"\0" + encode_frame(Frame(0, 0, message)))

    async def _keep_alive(self) -> None:
        while True:
            silent_s = self._loop.time() - self._heard_s
            if silent_s > SILENCE_S:
                self.lose(f"The board has said nothing for {silent_s:.1f} s; check the USB cable.")
                return
            self._write(messages.Heartbeat())
            await asyncio.sleep(messages.HEARTBEAT_PERIOD_MS / 1000)

    async def _ask_time(self) -> None:
        while True:
            token = self._asked % (1 << 16)
            self._asked += 1
            self._questions = {token: self._loop.time()}  # an older answer would come too late
            self._write(messages.Clock(token=token))
            quickly = self._asked < CLOCK_FIRST_QUESTIONS
            await asyncio.sleep(CLOCK_FIRST_PERIOD_S if quickly else CLOCK_PERIOD_S)
