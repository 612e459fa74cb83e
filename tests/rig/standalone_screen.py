"""What a person at the terminal sees of a board that stands alone, and may do to it."""

from __future__ import annotations

import asyncio
import json
import shutil
import sys
import threading
from collections.abc import Callable

from drivers.simulator.truth import GroundTruth
from tests.rig.control import Control, ControlError
from tests.rig.machine import true_joints
from tests.rig.standalone import StandaloneBoard
from tests.rig.truth import TrueState
from twin.joints import JointPosition

PERIOD_S = 0.2

LOG_PERIOD_S = 1.0
"""Into a file, and only what is new."""

STILL_MM = 1e-3

HELP = """\
Lines that do something to the board, with what undoes them:
  link unplugged | link plugged            the USB cable
  stop_button pressed | released           the emergency stop
  switch 0 cut | switch 0 whole            the wire of a limit switch: 0, 1, 2 for rho1, rho2, rho3
  jam on | jam off                         something holds the slide
  encoder dead | encoder alive             its lines stand still
  link cut | link whole                    both data wires
  faults 0.001 0.001 0 0 | faults 0 0 0 0  chances that a byte is lost, wrong, doubled; delay
  reset button | reset power | hang        the processor
  state | statistics                       only read"""


def live_line(state: TrueState, joints: JointPosition, *, moving: bool, truth: GroundTruth) -> str:
    """Power and motion, joints, force on the screw, and where the plug is."""
    power = "on " if state.power else "off"
    motion = "moving" if moving else "still "
    pressed = [
        name.removesuffix("_mm")
        for name, on in zip(JointPosition._fields, state.pressed, strict=True)
        if on
    ]
    depth_mm = truth.insertion_depth_mm
    plug = f"{depth_mm:.1f} mm deep" if depth_mm >= 0 else f"{-depth_mm:.0f} mm from the socket"
    return (
        f"motors {power} {motion}  "
        f"rho1 {joints.rho1_mm:6.1f}  rho2 {joints.rho2_mm:6.1f}  rho3 {joints.rho3_mm:6.1f} mm  "
        f"{state.load_n:5.1f} N  plug {plug}, {truth.lateral_error_mm:.2f} mm off"
        + (f"  switch {' '.join(pressed)}" if pressed else "")
    )


async def show(board: StandaloneBoard, truth: Callable[[], GroundTruth]) -> None:
    """Write the live line over and over, until the board ends."""
    terminal = sys.stdout.isatty()
    last: JointPosition | None = None
    shown = ""
    while board.process.returncode is None:
        state = await board.control.state()
        joints = true_joints(board.machine, state)
        moving = last is not None and any(
            abs(q - p) > STILL_MM for q, p in zip(joints, last, strict=True)
        )
        last = joints
        line = live_line(state, joints, moving=moving, truth=truth())
        if terminal:
            width = shutil.get_terminal_size().columns - 1
            print(f"\r\x1b[K{line[:width]}", end="", flush=True)
        elif line != shown:
            print(line, flush=True)
        shown = line
        await asyncio.sleep(PERIOD_S if terminal else LOG_PERIOD_S)


async def obey(control: Control) -> None:
    """Do what is typed and show the answer; a wrong line is answered with the help."""
    lines: asyncio.Queue[str] = asyncio.Queue()
    loop = asyncio.get_running_loop()
    # A thread that may be left waiting for a line: nobody can call it off.
    threading.Thread(target=_read, args=(loop, lines), name="keyboard", daemon=True).start()
    while True:
        line = await lines.get()
        try:
            print(json.dumps(await control.say(line)), flush=True)
        except ControlError as error:
            print(f"{error}\n{HELP}")


def _read(loop: asyncio.AbstractEventLoop, lines: asyncio.Queue[str]) -> None:
    for line in sys.stdin:
        if line.strip():
            loop.call_soon_threadsafe(lines.put_nowait, line.strip())
