"""The real robot behind the robot protocol."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Sequence

from drivers.arduino.connection import Connection, connect_board
from drivers.arduino.errors import LinkLostError
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import Fault
from drivers.arduino.serial_port import OpenLine, open_serial
from drivers.arduino.settings import BoardSettings
from drivers.robot import (
    BoardRefusedError,
    BoardState,
    NotConnectedError,
    RobotIdentity,
    RobotState,
    StopCategory,
)
from drivers.robot.link_health import LinkHealth
from drivers.robot.telemetry_feed import TelemetryFeed
from drivers.robot.traffic import Traffic
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits
from twin.motion.segments import Segment

_log = logging.getLogger(__name__)

MOVING = {BoardState.RUN, BoardState.STOPPING, BoardState.HOMING}

REST_S = 3.0
"""Closing the link waits so long for the robot to come to rest."""


class ArduinoRobot:
    """Implements RobotDriver on a board at a serial port.

    After the link was lost ``connect`` opens it anew. A board that was reset by that does not
    know its positions and says so: it is not homed.

    Args:
        port: Serial device, "auto" to look for it.
        geometry: Gives the travel of the joints.
        limits: How fast they may move.
        settings: Of the board.
        open_line: Opens the port.
    """

    def __init__(
        self,
        port: str,
        geometry: RobotGeometry,
        limits: MotionLimits,
        settings: BoardSettings,
        *,
        open_line: OpenLine = open_serial,
    ) -> None:
        self.traffic = Traffic()
        self._port = port
        self._open_line = open_line
        self._geometry = geometry
        self._limits = limits
        self._settings = settings
        self._feed = TelemetryFeed()
        self._connection: Connection | None = None
        self._connections = 0
        self._connecting = asyncio.Lock()
        self._closing: set[asyncio.Task[None]] = set()

    # --- RobotDriver -------------------------------------------------------------------------

    async def connect(self) -> RobotIdentity:
        """Open the link and wait until the board has identified itself.

        Raises:
            NotConnectedError: there is no board, it does not answer, or it is the wrong one; the
                message says what to do.
            BoardRefusedError: it does not take its configuration.
        """
        async with self._connecting:
            if self._closing:
                await asyncio.wait(self._closing)  # the port is opened exclusively
            if self._connection is None:
                self._connection = await connect_board(
                    self._port,
                    open_line=self._open_line,
                    settings=self._settings,
                    geometry=self._geometry,
                    limits=self._limits,
                    on_state=self._feed.publish,
                    on_lost=self._lose,
                    traffic=self.traffic,
                )
                self._connections += 1
            return self._connection.identity

    async def close(self) -> None:
        """Stop the motion (category 1) and close the link. Safe to call twice."""
        connection = self._connection
        if connection is not None:
            with contextlib.suppress(NotConnectedError, TimeoutError):
                async with asyncio.timeout(REST_S):
                    await self._come_to_rest(connection)
            self._connection = None
            await connection.close(NotConnectedError("The link to the board was closed."))
        if self._closing:
            await asyncio.wait(self._closing)
        self._feed.close()

    def telemetry(self) -> AsyncIterator[RobotState]:
        """Every sample from now on; ends when the link is lost or closed.

        Raises:
            NotConnectedError: there is no link.
        """
        self._require()
        return self._feed.subscribe()

    async def enable(self) -> None:
        """Energise the drives."""
        await self._require().command(messages.Enable())

    async def disable(self) -> None:
        """De-energise the drives; refused while moving."""
        await self._require().disable()

    async def home(self) -> None:
        """Seek the limit switches and set the positions; returns when done.

        The routine runs on the board: it goes on if the caller stops waiting.
        """
        await self._require().home()
        # Asked anew: the link may have broken right behind the answer, and its feed with it.
        async for state in self.telemetry():
            if state.board is BoardState.HOMING:
                continue
            if state.fault is not None:
                raise BoardRefusedError(f"Homing was ended by a fault: {state.fault.detail}")
            if not state.homed:
                raise BoardRefusedError("Homing was stopped before it was done.")
            return
        raise NotConnectedError("The link was lost during homing.")

    async def set_force_limit(self, force_n: float) -> None:
        """Cap the force of the rho3 actuator [N]; the board enforces it by itself."""
        largest_n = self._settings.slide.force_max_n
        if not 0.05 < force_n <= largest_n:  # also refuses NaN
            raise BoardRefusedError(
                f"A force limit of {force_n:g} N is not possible; it must be above 0 and at most "
                f"{largest_n:g} N.",
                "bad_value",
            )
        await self._require().command(messages.ForceLimit(force_dn=round(force_n * 10)))

    async def push(self, segments: Sequence[Segment]) -> None:
        """Append segments to the board's queue; all or none."""
        taken = tuple(segments)
        connection = self._require()
        if taken:
            await connection.push(taken)

    async def stop(self, category: StopCategory) -> None:
        """Drop the queue and decelerate; honoured in every state, idempotent."""
        await self._require().stop(lambda token: messages.Stop(category=int(category), token=token))

    async def emergency_stop(self) -> None:
        """Category 1 stop, then latch EMERGENCY_STOP."""
        await self._require().stop(
            lambda token: messages.EmergencyStop(fault=int(Fault.EMERGENCY_STOP), token=token)
        )

    async def clear_fault(self) -> None:
        """Release a latched fault whose cause is gone."""
        await self._require().clear_fault()

    # --- TellsLinkHealth ---------------------------------------------------------------------

    def link_health(self) -> LinkHealth:
        """The link now; without one only how often it was opened anew is known."""
        reconnections = max(self._connections - 1, 0)
        if self._connection is None:
            return LinkHealth(reconnections)
        return self._connection.gauge.read(reconnections)

    # --- inside ------------------------------------------------------------------------------

    def _require(self) -> Connection:
        if self._connection is None:
            raise NotConnectedError("There is no link to the board.")
        return self._connection

    def _lose(self, error: LinkLostError) -> None:
        """The link broke: streams of telemetry end, and ``connect`` may be called again."""
        _log.warning("the link to the motion board broke: %s", error)
        connection, self._connection = self._connection, None
        if connection is not None:
            task = asyncio.create_task(connection.close(error), name="close board port")
            self._closing.add(task)
            task.add_done_callback(self._closing.discard)
        self._feed.close()

    async def _come_to_rest(self, connection: Connection) -> None:
        reader = self._feed.subscribe()
        await connection.stop(
            lambda token: messages.Stop(category=StopCategory.DECELERATE_AND_RELEASE, token=token)
        )
        async for state in reader:
            if state.board not in MOVING and not state.enabled:
                return
