"""A board that stands alone: in real time, with a device path that any host may open."""

from __future__ import annotations

import asyncio
import contextlib
import tempfile
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path

from tests.rig.build import Programs
from tests.rig.control import Control
from tests.rig.device.channel import SocketChannel
from tests.rig.machine import Machine

START_S = 10.0
SAMPLE_S = 0.01


@dataclass(frozen=True, slots=True)
class StandaloneBoard:
    """A board that runs by itself.

    Attributes:
        control: Truth and faults.
        machine: What hangs on it.
        port: Device of its USB port.
        process: Runs it.
    """

    control: Control
    machine: Machine
    port: Path
    process: asyncio.subprocess.Process


@contextlib.asynccontextmanager
async def standing_alone(
    programs: Programs, machine: Machine, port: Path
) -> AsyncIterator[StandaloneBoard]:
    """Run a board in real time until the block ends.

    Args:
        programs: Firmware and simulator.
        machine: What hangs on the board.
        port: Where its device appears: a link to a pseudo terminal. Whatever is there is replaced.
    """
    with tempfile.TemporaryDirectory() as scratch:
        socket = Path(scratch) / "control"
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
            start_new_session=True,  # Ctrl+C is for this program, which then ends that one
        )
        try:
            await _wait_until_ready(process)
            channel = await SocketChannel.connect(socket)
            try:
                yield StandaloneBoard(Control(channel), machine, port, process)
            finally:
                await channel.close()
        finally:
            # the simulator ends with its standard input
            await process.communicate(b"")


async def _wait_until_ready(process: asyncio.subprocess.Process) -> None:
    assert process.stdout is not None
    async with asyncio.timeout(START_S):
        if await process.stdout.readline() != b"ready\n":
            raise RuntimeError("the simulator has not started; see its words above")
