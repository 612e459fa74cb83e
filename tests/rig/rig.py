"""One board in the rig: a process that runs the firmware, and the channel to it."""

from __future__ import annotations

import asyncio
import contextlib
import tempfile
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.settings import BoardSettings, SlideSettings
from tests.rig.build import Programs
from tests.rig.control import Control
from tests.rig.machine import Machine, true_joints
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion import MotionLimits

START_S = 10.0
SAMPLE_S = 0.01

STANDING = JointPosition(150.0, 140.0, 70.0)
"""Where the robot stands at power-up unless a test says otherwise: away from every switch."""

DEFAULTS = BoardSettings()
BRISK = {"seek_speed_mm_s": 70.0, "locate_speed_mm_s": 5.0, "homing_acceleration_mm_s2": 1000.0}
TUNED = BoardSettings(
    rho1=DEFAULTS.rho1.model_copy(update=BRISK),
    rho2=DEFAULTS.rho2.model_copy(update=BRISK),
    slide=SlideSettings(ki_pwm_per_count_s=20.0, integral_pwm_max=150),
)
"""Homing in a third of the time; and an integral that can carry the whole force of the insertion,
without which the slide would stop short of its place and the board would wait for ever."""


@dataclass(frozen=True, slots=True)
class Rig:
    """A running board.

    Attributes:
        control: Truth and faults.
        port: Device of its USB port.
        machine: What hangs on it.
    """

    control: Control
    port: Path
    machine: Machine

    def robot(self, limits: MotionLimits | None = None) -> ArduinoRobot:
        """The real driver for it."""
        machine = self.machine
        return ArduinoRobot(
            str(self.port), machine.geometry, limits or MotionLimits(), machine.settings
        )

    async def true_joints(self) -> JointPosition:
        """Where carriages and slide truly are."""
        return true_joints(self.machine, await self.control.state())


def standing_machine(start: JointPosition = STANDING) -> Machine:
    """The machine of the default geometry."""
    return Machine(RobotGeometry(), TUNED, start)


@contextlib.asynccontextmanager
async def running_rig(
    programs: Programs, machine: Machine | None = None, *, speed: float = 1.0
) -> AsyncIterator[Rig]:
    """Run a board until the block ends.

    Args:
        programs: Firmware and simulator.
        machine: What hangs on the board; None takes the one of the default geometry.
        speed: Simulated seconds per second of the wall clock.
    """
    machine = machine or standing_machine()
    with tempfile.TemporaryDirectory() as scratch:
        port, channel = Path(scratch) / "port", Path(scratch) / "control"
        options: dict[str, object] = {
            "firmware": programs.firmware,
            "pty": port,
            "control": channel,
            "speed": speed,
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
            control = await Control.connect(channel)
            try:
                yield Rig(control, port, machine)
            finally:
                await control.close()
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
