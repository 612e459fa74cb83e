"""The control channel of the simulator: what truly is, and what goes wrong."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Self

from pydantic import BaseModel, ConfigDict


class _Answer(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class TrueState(_Answer):
    """Where everything truly is.

    Attributes:
        at_s: When, in the time of the event loop (the wall clock's share of it).
        simulated_s: When, in simulated time since the start.
        rho1_steps: True position of the carriage in microsteps.
        rho2_steps: The same.
        rho3_mm: True position of the slide.
        rho3_mm_s: Its velocity.
        load_n: Force against the slide's screw, positive against going out.
        pwm: What the bridge gets.
        power: The motors have power.
        relay: The firmware lets them have it.
        pressed: Limit switches of rho1, rho2, rho3.
        resets: Of the microcontroller so far.
    """

    at_s: float
    simulated_s: float
    rho1_steps: int
    rho2_steps: int
    rho3_mm: float
    rho3_mm_s: float
    load_n: float
    pwm: int
    power: bool
    relay: bool
    pressed: tuple[bool, bool, bool]
    resets: int


class RailStatistics(_Answer):
    """What a stepper driver has seen; times are 0 before there are any.

    Attributes:
        steps: Pulses.
        lost: Of them, those that moved nothing: against a stop, or without power.
        shortest_pulse_us: STEP high.
        shortest_set_up_us: From a change of DIR to STEP.
        shortest_interval_us: Between two steps.
    """

    steps: int
    lost: int
    shortest_pulse_us: float
    shortest_set_up_us: float
    shortest_interval_us: float


class Statistics(_Answer):
    """What tick, line and simulator have been like since ``forget``.

    Attributes:
        ticks: Step interrupts.
        late_ticks: Of them, those that began more than half a tick after their time.
        tick_interval_us: Shortest and longest between two of them.
        longest_tick_us: Duration of the interrupt.
        rounds: Of the closed loop of rho3, nominally one a millisecond.
        longest_round_us: Between two of them.
        tick_share: Of the CPU's time, in this interrupt.
        awake_share: Of the CPU's time, not asleep.
        overruns: Bytes that the UART lost (never forgotten, like all counts of bytes).
        wrong_baud: Bytes that came at another speed.
        bytes_to_board: From the host.
        bytes_to_host: From the board.
        worst_lag_s: How far the simulation was behind the wall clock.
        slept_s: What it had left over.
        elapsed_s: Wall time.
        rails: The steppers of rho1 and rho2.
    """

    ticks: int
    late_ticks: int
    tick_interval_us: tuple[float, float]
    longest_tick_us: float
    rounds: int
    longest_round_us: float
    tick_share: float
    awake_share: float
    overruns: int
    wrong_baud: int
    bytes_to_board: int
    bytes_to_host: int
    worst_lag_s: float
    slept_s: float
    elapsed_s: float
    rails: tuple[RailStatistics, RailStatistics]


class ControlError(RuntimeError):
    """The simulator refused a command or has ended."""


class Control:
    """The client's end; see auriga/commands.hpp for what the simulator obeys."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader = reader
        self._writer = writer
        self._waiting: deque[asyncio.Future[dict[str, Any]]] = deque()
        self._listeners: list[Callable[[TrueState], None]] = []
        self._task = asyncio.create_task(self._listen(), name="rig control")

    @classmethod
    async def connect(cls, path: Path) -> Self:
        """Open the channel of a running simulator."""
        return cls(*await asyncio.open_unix_connection(path))

    async def close(self) -> None:
        """Hang up."""
        self._task.cancel()
        await asyncio.wait([self._task])
        self._writer.close()
        await self._writer.wait_closed()

    def on_sample(self, listener: Callable[[TrueState], None]) -> None:
        """Call with every sample that the simulator sends by itself."""
        self._listeners.append(listener)

    # --- what is -----------------------------------------------------------------------------

    async def state(self) -> TrueState:
        """The truth now."""
        return await self._do("state")

    async def statistics(self) -> Statistics:
        """Since the start or ``forget``."""
        return Statistics.model_validate(await self.say("statistics"))

    async def forget(self) -> None:
        """Begin the statistics anew."""
        await self.say("forget")

    # --- what goes wrong; each returns the truth at that very moment -------------------------

    def load_soon(self, first_mm: float, spacing_mm: float, force_n: Sequence[float]) -> None:
        """Force against the screw over its position, held beyond the ends; waits for no answer."""
        forces = " ".join(f"{force:.3f}" for force in force_n)
        answer = self._send(f"load {first_mm:.5f} {spacing_mm:.5f} {forces}")
        answer.add_done_callback(lambda done: done.cancelled() or done.exception())

    async def cut_switch(self, axis: int, *, cut: bool = True) -> TrueState:
        """Wire of a limit switch: 0, 1, 2 for rho1, rho2, rho3."""
        return await self._do(f"switch {axis} {'cut' if cut else 'whole'}")

    async def press_stop_button(self, *, pressed: bool = True) -> TrueState:
        """The emergency-stop button: opens the circuit and cuts the motors' power."""
        return await self._do(f"stop_button {'pressed' if pressed else 'released'}")

    async def jam(self, *, jammed: bool = True) -> TrueState:
        """Hold the slide where it is."""
        return await self._do(f"jam {'on' if jammed else 'off'}")

    async def kill_encoder(self, *, dead: bool = True) -> TrueState:
        """The encoder's lines stand still."""
        return await self._do(f"encoder {'dead' if dead else 'alive'}")

    async def reset(self, *, power: bool = False) -> TrueState:
        """Press the board's reset button, or take its power for a moment."""
        return await self._do(f"reset {'power' if power else 'button'}")

    async def hang(self) -> TrueState:
        """The firmware's main loop never comes round again."""
        return await self._do("hang")

    async def cut_link(self, *, cut: bool = True) -> TrueState:
        """Both data wires; the host still sees its device."""
        return await self._do(f"link {'cut' if cut else 'whole'}")

    async def unplug(self) -> TrueState:
        """Pull the USB plug: the host's device vanishes."""
        return await self._do("link unplugged")

    async def plug_in(self) -> TrueState:
        """Put the USB plug back."""
        return await self._do("link plugged")

    async def spoil_link(
        self,
        *,
        lose: float = 0.0,
        flip: float = 0.0,
        duplicate: float = 0.0,
        delay_s: float = 0.0,
    ) -> TrueState:
        """Chances per byte that it is lost, gets a wrong bit, or comes twice; both ways."""
        return await self._do(f"faults {lose:g} {flip:g} {duplicate:g} {delay_s:g}")

    # --- the channel -------------------------------------------------------------------------

    async def say(self, line: str) -> dict[str, Any]:
        """Send a command and wait for its answer.

        Raises:
            ControlError: it was refused, or the simulator has ended.
        """
        return await self._send(line)

    async def _do(self, line: str) -> TrueState:
        return TrueState.model_validate(await self.say(line))

    def _send(self, line: str) -> asyncio.Future[dict[str, Any]]:
        answer: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        if self._task.done():
            answer.set_exception(ControlError("the simulator has ended"))
        else:
            self._waiting.append(answer)
            self._writer.write(line.encode() + b"\n")
        return answer

    async def _listen(self) -> None:
        try:
            while line := await self._reader.readline():
                self._take(json.loads(line))
        finally:
            while self._waiting:
                self._fail(self._waiting.popleft(), "the simulator has ended")

    def _take(self, message: dict[str, Any]) -> None:
        if "sample" in message:
            sample = TrueState.model_validate(message["sample"])
            for listener in self._listeners:
                listener(sample)
            return
        answer = self._waiting.popleft()
        if "error" in message:
            self._fail(answer, message["error"])
        elif not answer.done():
            answer.set_result(message)

    @staticmethod
    def _fail(answer: asyncio.Future[dict[str, Any]], words: str) -> None:
        if not answer.done():
            answer.set_exception(ControlError(words))
