"""One board in real time, behind a device of its own."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import AsyncIterator
from pathlib import Path

from drivers.arduino.driver import ArduinoRobot
from tests.rig.build import Programs
from tests.rig.machine import standing_machine
from tests.rig.standalone import StandaloneBoard, standing_alone
from twin.motion import MotionLimits


@contextlib.asynccontextmanager
async def running_device(programs: Programs) -> AsyncIterator[StandaloneBoard]:
    """Run a board until the block ends."""
    with tempfile.TemporaryDirectory() as folder:
        port = Path(folder) / "port"
        async with standing_alone(programs, standing_machine(), port) as board:
            yield board


def robot_at(board: StandaloneBoard) -> ArduinoRobot:
    """The real driver for it, as it is used everywhere."""
    machine = board.machine
    return ArduinoRobot(str(board.port), machine.geometry, MotionLimits(), machine.settings)
