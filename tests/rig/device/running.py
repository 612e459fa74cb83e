"""One board in real time: a process that runs the firmware behind a pseudo terminal."""

from __future__ import annotations

import asyncio
import contextlib
import tempfile
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path

from drivers.arduino.driver import ArduinoRobot
from tests.rig.build import Programs
from tests.rig.control import Control
from tests.rig.device.channel import SocketChannel
from tests.rig.machine import Machine, standing_machine
from twin.motion import MotionLimits

START_S = 30.0
SAMPLE_S = 0.01


@dataclass(frozen=True, slots=True)
class DeviceRig:
    """A running board.

    Attributes:
        control: Truth and faults.
        port: Device of its USB port.
        machine: What hangs on it.
    """

    control: Control
    port: Path
    machine: Machine

    def robot(self) -> ArduinoRobot:
        """The real driver for it."""
        machine = self.machine
        return ArduinoRobot(str(self.port), machine.geometry, MotionLimits(), machine.settings)


@contextlib.asynccontextmanager
async def running_device(programs: Programs) -> AsyncIterator[DeviceRig]:
    """Run a board until the block ends."""
    machine = standing_machine()
    with tempfile.TemporaryDirectory() as scratch:
        port, socket = Path(scratch) / "port", Path(scratch) / "control"
        options: dict[str, object] = {
            "clock": "wall",
            "firmware": programs.firmware,
            "pty": port,
            "control": socket,
            "sample_s": SAMPLE_S,
            **machine.options(),
        }
        process = await asyncio.create_subprocess_exec(
            programs.simulator,
            *(f"{name}={value}" for name, value in options.items()),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
        )
        try:
            await _wait_until_ready(process)
            channel = await SocketChannel.connect(socket)
            try:
                yield DeviceRig(Control(channel), port, machine)
            finally:
                await channel.close()
        finally:
            # the simulator ends with its standard input
            await process.communicate(b"")


async def _wait_until_ready(process: asyncio.subprocess.Process) -> None:
    assert process.stdout is not None
    async with asyncio.timeout(START_S):
        while line := await process.stdout.readline():
            if line == b"ready\n":
                return
    raise AssertionError("the simulator has not started; see what it wrote to standard error")
