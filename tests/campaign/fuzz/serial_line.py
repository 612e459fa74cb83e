"""A motion board that lies: the real driver at a line on which anything may come."""

from __future__ import annotations

import asyncio
import contextlib
import random
import time

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.link.frames import Frame, FrameReader, encode_frame
from drivers.arduino.protocol.messages import FROM_BOARD, MESSAGES, TICK_HZ
from drivers.arduino.serial_port import OnFrames, OnLost
from drivers.arduino.settings import BoardSettings
from drivers.robot import RobotDriverError, StopCategory
from server.timing import NothingLeftToWaitForError, VirtualTimeLoop
from tests.campaign.fuzz.target import BrokenError, mutated
from tests.support.fake_board import FakeBoard
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits

STEP_S = 0.002
ORDERS = 30
LATEST_S = 10.0
"""After so long a cable is pulled, which ends whatever waits for the board."""

LONGEST_S = 2 * ORDERS * LATEST_S
"""Of virtual time for one life; longer means that somebody waits for ever."""


class HostileLine:
    """A line to a fake board; what the board says is changed on the way, now and then.

    Attributes:
        changed: Pieces that were changed or made up.
    """

    def __init__(self, rng: random.Random, on_frames: OnFrames, on_lost: OnLost) -> None:
        self.changed = 0
        self._rng = rng
        self._malice = rng.choice((0.0, 0.01, 0.1, 0.5))
        self._on_frames = on_frames
        self._on_lost = on_lost
        self._frames = FrameReader(FROM_BOARD)
        self._loop = asyncio.get_running_loop()
        self._board = FakeBoard(self._say)
        self._living = self._loop.create_task(self._live())

    def write(self, data: bytes) -> None:
        """Bytes of the host, which are sometimes damaged, too."""
        if self._rng.random() < self._malice:
            data = mutated(data, self._rng)
            self.changed += 1
        with contextlib.suppress(AssertionError):  # the fake board judges its host
            self._board.hear(data)

    async def close(self) -> None:
        """Pull the cable."""
        self._living.cancel()
        await asyncio.gather(self._living, return_exceptions=True)

    def _say(self, data: bytes) -> None:
        if self._rng.random() < self._malice:
            self.changed += 1
            data = self._lie() if self._rng.random() < 0.5 else mutated(data, self._rng)
        self._loop.call_soon(self._arrive, data)

    def _lie(self) -> bytes:
        """A frame that is right in its form and says anything."""
        kind = MESSAGES[self._rng.choice(sorted(FROM_BOARD))]
        message = kind.unpack(self._rng.randbytes(kind.LAYOUT.size))
        return encode_frame(Frame(self._rng.randrange(256), self._rng.randrange(256), message))

    def _arrive(self, data: bytes) -> None:
        self._on_frames(list(self._frames.feed(data)), self._loop.time())

    async def _live(self) -> None:
        began_s = self._loop.time()
        while (lived_s := self._loop.time() - began_s) < LATEST_S:
            self._board.advance(int(lived_s * TICK_HZ))
            await asyncio.sleep(STEP_S)
        self._on_lost("the cable was pulled")


class SerialLine:
    """Sessions of the driver with boards that lie."""

    name = "serial protocol"

    def __init__(self, rng: random.Random) -> None:
        self.tried = 0
        self._rng = rng

    def run(self, until_s: float) -> None:
        """Try one session after the other; their changed pieces are counted."""
        while time.monotonic() < until_s:
            seed = self._rng.getrandbits(32)
            self.tried += one_session(seed)


def one_session(seed: int) -> int:
    """One life of the driver, in virtual time; returns how many pieces were changed.

    Raises:
        BrokenError: the driver failed with something else than its own errors, or waits for ever.
    """
    surprises: list[str] = []
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.get_loop().set_exception_handler(
            lambda _, context: surprises.append(str(context.get("exception", context["message"])))
        )
        try:
            changed = runner.run(_live(random.Random(seed)))
        except (Exception, NothingLeftToWaitForError) as error:
            raise BrokenError(f"board with seed {seed}: {error!r}") from error
    if surprises:
        raise BrokenError(f"board with seed {seed}: {surprises}")
    return changed


async def _live(rng: random.Random) -> int:
    lines: list[HostileLine] = []

    async def open_line(device: str, on_frames: OnFrames, on_lost: OnLost) -> HostileLine:
        del device
        lines.append(HostileLine(rng, on_frames, on_lost))
        return lines[-1]

    robot = ArduinoRobot(
        "ttyFuzz", RobotGeometry(), MotionLimits(), BoardSettings(), open_line=open_line
    )
    async with asyncio.timeout(LONGEST_S):
        for _ in range(ORDERS):
            with contextlib.suppress(RobotDriverError):
                await robot.connect()
                await _some_order(robot, rng)
        await robot.close()
        for line in lines:
            await line.close()
    return sum(line.changed for line in lines)


async def _some_order(robot: ArduinoRobot, rng: random.Random) -> None:
    """Whatever the server may want next."""
    match rng.randrange(7):
        case 0:
            await robot.enable()
        case 1:
            await robot.home()
        case 2:
            await robot.set_force_limit(rng.uniform(1, 60))
        case 3:
            await robot.stop(rng.choice(list(StopCategory)))
        case 4:
            await robot.emergency_stop()
        case 5:
            await robot.clear_fault()
        case _:
            telemetry = robot.telemetry()
            for _ in range(rng.randrange(20)):
                await anext(telemetry, None)
