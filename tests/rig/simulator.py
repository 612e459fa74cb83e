"""A simulator whose time passes only while it is asked to let it pass."""

from __future__ import annotations

import json
import math
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.rig.control import CPU_HZ, ControlError
from tests.rig.truth import TrueState


@dataclass(frozen=True, slots=True)
class Passage:
    """What happened while time passed.

    Attributes:
        cycle: Clock cycles of the processor since the start, now.
        received: Bytes that came out of the cable at the host's end; after the last one no more
            time has passed.
        lost: The port was open, and its device has vanished.
    """

    cycle: int
    received: bytes
    lost: bool


class Simulator:
    """The process, and a Channel to it; see auriga/lock_step.hpp.

    Args:
        program: To run.
        options: Of its command line.
    """

    def __init__(self, program: Path, options: Mapping[str, object]) -> None:
        self._process = subprocess.Popen(
            [program, *(f"{name}={value}" for name, value in options.items())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._cycle = 0
        self._listeners: list[Callable[[TrueState], None]] = []
        if self._read() != "ready\n":
            raise ControlError("the simulator has not started; see its standard error")

    def close(self) -> None:
        """End it."""
        self._process.communicate()

    def on_sample(self, listener: Callable[[TrueState], None]) -> None:
        """Call with every sample that the simulator takes by itself."""
        self._listeners.append(listener)

    def ask(self, line: str) -> dict[str, Any]:
        """Give a command; no simulated time passes unless it is ``run``.

        Raises:
            ControlError: it was refused, or the simulator has ended.
        """
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(line + "\n")
            self._process.stdin.flush()
        except BrokenPipeError as error:
            raise ControlError("the simulator has ended") from error
        answer: dict[str, Any] = json.loads(self._read())
        if "error" in answer:
            raise ControlError(answer["error"])
        return answer

    async def say(self, line: str) -> dict[str, Any]:
        """The same as ``ask``."""
        return self.ask(line)

    def say_soon(self, line: str) -> None:
        """The same as ``ask``, without an answer."""
        self.ask(line)

    def run(self, until_s: float) -> Passage:
        """Let time pass until then [s since the start], or until there is something for the host.

        Listeners get a sample at the instant it was taken. At least one cycle passes, so that
        whoever waits for an instant a rounding error away gets there.
        """
        until = max(math.ceil(until_s * CPU_HZ), self._cycle + 1)
        answer = self.ask(f"run {until}")
        self._cycle = answer["cycle"]
        if answer["sample"] is not None:
            sample = TrueState.model_validate(answer["sample"])
            for listener in self._listeners:
                listener(sample)
        return Passage(answer["cycle"], bytes.fromhex(answer["received"]), answer["lost"])

    def _read(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise ControlError("the simulator has ended; see its standard error")
        return line
