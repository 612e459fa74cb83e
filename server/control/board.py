"""The motion board as the supervisor speaks to it, with its refusals in words."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable, Sequence

from drivers.robot import (
    BoardState,
    NotConnectedError,
    RobotDriver,
    RobotDriverError,
    RobotState,
    StopCategory,
)
from server.control.errors import (
    ControlError,
    FaultRemainsError,
    MotionRefusedError,
    RobotOfflineError,
)
from server.control.finishing import finish
from server.control.model import RobotMode
from server.control.modes import why_not_moving
from server.control.telemetry import Telemetry
from twin.motion.segments import Segment

_log = logging.getLogger(__name__)

ANSWER_S = 1.0
"""Longest time until the telemetry shows what a command has done."""

MOVING = {BoardState.RUN, BoardState.STOPPING, BoardState.HOMING}

STILL_MM_S = 1.0
"""Slower than this a joint has come to rest. A board with a fault may still be braking."""

_SPEAK_FOR_THEMSELVES = {
    RobotMode.OFFLINE,
    RobotMode.EMERGENCY_STOP,
    RobotMode.STOPPING,
    RobotMode.STOPPED,
    RobotMode.FAULT,
}
"""Modes that are the reason when the board refuses something."""

Command = Callable[[], Awaitable[None]]

OnSegments = Callable[[Sequence[Segment]], None]


class Board:
    """Commands to the driver.

    Args:
        driver: The motion board.
        telemetry: What it reports.
        mode: Tells what the robot is doing.

    Attributes:
        on_segments: Called with all segments that the board has accepted, in joints of the drawing.
    """

    def __init__(
        self, driver: RobotDriver, telemetry: Telemetry, mode: Callable[[], RobotMode]
    ) -> None:
        self.driver = driver
        self.telemetry = telemetry
        self.on_segments: OnSegments = lambda _: None
        self._mode = mode

    async def command(self, call: Command) -> None:
        """Carry out a command.

        Raises:
            ControlError: the board refused, with the reason behind it.
        """
        self.telemetry.require()
        try:
            await call()
        except RobotDriverError as error:
            raise await self._explain(error) from error

    async def push(self, segments: Sequence[Segment], *, drawn: Sequence[Segment]) -> None:
        """Send segments to the board's queue.

        Args:
            segments: In joints of the board.
            drawn: The same in joints of the drawing.

        Raises:
            ControlError: the board refused, with the reason behind it.
        """
        await self.command(lambda: self.driver.push(segments))
        self.on_segments(drawn)

    async def home(self) -> None:
        """Home; whatever ends it early brings the robot to rest first.

        Raises:
            ControlError: the board refused, or homing failed.
        """
        try:
            await self.command(self.driver.home)
        except BaseException:
            await finish(self.come_to_rest())
            raise
        await self.until(lambda state: state.homed and state.board is BoardState.READY)

    async def clear_fault(self) -> None:
        """Release the latched fault.

        Raises:
            FaultRemainsError: its cause is still there.
            RobotOfflineError: there is no link.
        """
        try:
            await self.driver.clear_fault()
        except NotConnectedError as error:
            raise RobotOfflineError(f"The link to the motion board is down: {error}") from error
        except RobotDriverError as error:
            raise FaultRemainsError(f"The motion board keeps its fault. {error}") from error
        await self.until(lambda state: state.board is not BoardState.FAULT)

    async def until(self, condition: Callable[[RobotState], bool]) -> None:
        """Wait until the telemetry shows that a command has had its effect.

        Raises:
            MotionRefusedError: it does not show.
            RobotOfflineError: the link went down.
        """
        try:
            async with asyncio.timeout(ANSWER_S):
                while not condition(self.telemetry.require()):
                    await self.telemetry.next()
        except TimeoutError:
            raise MotionRefusedError("The motion board did not do what it was told.") from None

    async def tell_to_stop(self, call: Command) -> None:
        """Send a stop; what goes wrong is only written down.

        The server has latched the stop already, and a board that cannot be reached stops when
        its heartbeat is missing.
        """
        try:
            await call()
        except RobotDriverError as error:
            _log.warning("the stop did not reach the motion board: %s", error)

    async def come_to_rest(self) -> None:
        """Stop with category 2 and wait until the robot stands still.

        Never raises: whoever asks for this is on the way out already.
        """
        await self.tell_to_stop(lambda: self.driver.stop(StopCategory.DECELERATE_AND_HOLD))
        try:
            async with asyncio.timeout(ANSWER_S):
                # An older sample may show the rest before the motion.
                state = await self.telemetry.reach(asyncio.get_running_loop().time())
                while not _at_rest(state):
                    state = await self.telemetry.next()
        except RobotOfflineError:
            _log.warning("nobody can see whether the robot stands still: the link is down")
        except TimeoutError:
            _log.error("the robot has not come to rest within %.0f s of a stop", ANSWER_S)

    async def _explain(self, error: RobotDriverError) -> ControlError:
        """The error behind a refusal, which the telemetry shows a little later than the board."""
        if isinstance(error, NotConnectedError):
            return RobotOfflineError(f"The link to the motion board is down: {error}")
        try:
            async with asyncio.timeout(ANSWER_S):
                await self.telemetry.reach(asyncio.get_running_loop().time())
        except (TimeoutError, RobotOfflineError):
            return RobotOfflineError(f"The motion board refused, then fell silent: {error}")
        mode = self._mode()
        problem = why_not_moving(mode, self.telemetry.latest)
        if problem is not None and mode in _SPEAK_FOR_THEMSELVES:
            return problem
        return MotionRefusedError(f"The motion board refused: {error}")


def _at_rest(state: RobotState) -> bool:
    slow = max(abs(v) for v in state.measured.velocity) < STILL_MM_S
    return slow and state.board not in MOVING
