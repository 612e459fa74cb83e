"""One board in the rig: a process that runs the firmware in step with the event loop."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import NamedTuple

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.link.frames import Frame
from tests.rig.build import Programs
from tests.rig.cable import Cable
from tests.rig.control import CPU_HZ, Control
from tests.rig.loop import LockStepLoop
from tests.rig.machine import Machine, standing_machine, true_joints
from tests.rig.simulator import Simulator
from twin.joints import JointPosition
from twin.motion import MotionLimits

SAMPLE_S = 0.01
"""Period of the samples of the true state."""

LONGEST_S = 150.0
"""No test lives longer; one that would waits for what never happens."""

USB_LATENCY_S = 1e-3
"""Of a byte, each way: the bridge fills a packet, and USB polls once a millisecond."""


class Heard(NamedTuple):
    """A frame of the board and when it came, in event loop time."""

    at_s: float
    frame: Frame


class Rig:
    """A running board; a World for its event loop.

    Attributes:
        control: Truth and faults.
        machine: What hangs on it.
        heard: Every frame that came out of the cable.
    """

    def __init__(self, simulator: Simulator, machine: Machine, began_s: float) -> None:
        self.control = Control(simulator)
        self.machine = machine
        self.heard: list[Heard] = []
        self.cable = Cable(simulator)
        self._simulator = simulator
        self._began_s = began_s

    def robot(self, limits: MotionLimits | None = None) -> ArduinoRobot:
        """The real driver for it."""
        return ArduinoRobot(
            "rig",
            self.machine.geometry,
            limits or MotionLimits(),
            self.machine.settings,
            open_line=self.cable.open_line,
        )

    async def true_joints(self) -> JointPosition:
        """Where carriages and slide truly are."""
        return true_joints(self.machine, await self.control.state())

    def loop_time_s(self, simulated_s: float) -> float:
        """Event loop time of a simulated time since the start."""
        return self._began_s + simulated_s

    async def stall_host(self, duration_s: float) -> None:
        """Let time pass without anybody on the host getting a turn, as if it hung."""
        loop = asyncio.get_running_loop()
        assert isinstance(loop, LockStepLoop)
        loop.stall(duration_s)
        await asyncio.sleep(0)

    def live(self, until_s: float) -> float:
        """Live until then, or until the board says something; returns the time it has become."""
        if until_s - self._began_s > LONGEST_S:
            raise TimeoutError(f"the test has not ended after {LONGEST_S:g} simulated seconds")
        passage = self._simulator.run(until_s - self._began_s)
        now_s = self._began_s + passage.cycle / CPU_HZ
        end = self.cable.end
        if end is not None and passage.received:
            self.heard += [Heard(now_s, frame) for frame in end.receive(passage.received, now_s)]
        if end is not None and passage.lost:
            end.lose()
        return now_s


@contextlib.asynccontextmanager
async def running_rig(
    programs: Programs, machine: Machine | None = None, *, sample_s: float = SAMPLE_S
) -> AsyncIterator[Rig]:
    """Run a board in step with the running event loop until the block ends.

    Args:
        programs: Firmware and simulator.
        machine: What hangs on the board; None takes the one of the default geometry.
        sample_s: Period of the samples of the true state.
    """
    loop = asyncio.get_running_loop()
    assert isinstance(loop, LockStepLoop)
    machine = machine or standing_machine()
    began_s = loop.time()
    simulator = Simulator(
        programs.simulator,
        {
            "clock": "host",
            "firmware": programs.firmware,
            "began_s": began_s,
            "latency_s": USB_LATENCY_S,
            "sample_s": sample_s,
            **machine.options(),
        },
    )
    rig = Rig(simulator, machine, began_s)
    loop.join(rig)
    try:
        yield rig
    finally:
        loop.leave()
        simulator.close()
