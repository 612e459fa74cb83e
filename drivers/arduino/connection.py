"""The live link to one board: its session, where it is, and what it is told."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence

from drivers.arduino.board_finder import find_board
from drivers.arduino.configuration import configuration_crc, configuration_messages
from drivers.arduino.errors import LinkLostError
from drivers.arduino.handshake import Handshake
from drivers.arduino.link.frames import Frame
from drivers.arduino.link_gauge import LinkGauge
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import Fault, ResetCause, State, TelemetryFlag
from drivers.arduino.scale import AxisScale
from drivers.arduino.serial_port import OpenLine
from drivers.arduino.session import Session
from drivers.arduino.settings import BoardSettings
from drivers.arduino.tap import TappedLine
from drivers.arduino.tracker import Tracker
from drivers.arduino.words import BOARD_NAMES
from drivers.robot import BoardRefusedError, NotConnectedError, RobotIdentity, RobotState
from drivers.robot.segment_rules import SegmentRules
from drivers.robot.traffic import Traffic
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits
from twin.motion.segments import Segment

_log = logging.getLogger(__name__)

FIRST_SAMPLE_S = 1.0

OnState = Callable[[RobotState], None]
OnLost = Callable[[LinkLostError], None]
MakeStop = Callable[[int], Message]


class Connection:
    """A board that has identified itself.

    Args:
        port: It answers on.
        hello: How it introduced itself.
        settings: Of the board.
        geometry: Gives the travel of the joints.
        limits: How fast they may move.
        on_state: Gets every sample.
        on_lost: Called once when the link has broken.

    Attributes:
        identity: How the board introduced itself.
        session: Carries what is said.
        gauge: Measures how well that goes.
    """

    def __init__(
        self,
        port: TappedLine,
        hello: messages.Hello,
        *,
        settings: BoardSettings,
        geometry: RobotGeometry,
        limits: MotionLimits,
        on_state: OnState,
        on_lost: OnLost,
    ) -> None:
        self.identity = _identity(hello)
        self._port = port
        self._hello = hello
        self._configuration = configuration_messages(settings, geometry, limits)
        self._on_state = on_state
        rules = SegmentRules(
            travel=geometry.joint_ranges,
            limits=limits.joints,
            longest_s=self.identity.segment_s,
            position_tolerance_mm=settings.position_tolerance_mm,
            velocity_tolerance_mm_s=settings.velocity_tolerance_mm_s,
            limit_tolerance_mm=settings.limit_tolerance_mm,
            speed_tolerance=settings.speed_tolerance,
        )
        scales = [AxisScale(axis.units_per_mm) for axis in settings.axes]
        self._tracker = Tracker(scales, rules, hello.queue_capacity)
        self._fresh = asyncio.Event()
        self._stops_under_way = 0
        self._told_damage = False
        self._emergency: asyncio.Task[None] | None = None
        self.session = Session(port, self._take_sample, on_lost)
        self.gauge = LinkGauge(port, self.session)

    async def configure(self) -> None:
        """Give the board its configuration unless it has it, and wait for its first sample.

        Raises:
            BoardRefusedError: it does not take it.
            NotConnectedError: the link broke.
        """
        crc = configuration_crc(self._configuration)
        if self._hello.config_crc != crc or self._hello.state == State.BOOT:
            commit = messages.ConfigCommit(crc=crc, save=1)
            await self.command(*self._configuration, commit)
        try:
            async with asyncio.timeout(FIRST_SAMPLE_S):
                await self._fresh.wait()
        except TimeoutError:
            raise NotConnectedError("The board identified itself but sends no telemetry.") from None

    async def command(self, *commands: Message) -> None:
        """Send sequenced messages and wait until the board has obeyed all of them.

        Raises:
            BoardRefusedError: it refused one.
            NotConnectedError: the link broke.
        """
        await self.session.command(*commands)

    async def home(self) -> None:
        """Begin homing."""
        await self.command(messages.Home())
        self._distrust()

    async def disable(self) -> None:
        """De-energise the drives; what is turned by hand then stands where it is measured."""
        await self.command(messages.Disable())
        self._distrust()

    async def clear_fault(self) -> None:
        """Release a latched fault."""
        await self.command(messages.ClearFault())
        if not self._tracker.running:
            self._distrust()

    async def push(self, segments: Sequence[Segment]) -> None:
        """Append segments to the board's queue.

        Raises:
            QueueFullError: they do not fit.
            BoardRefusedError: the board cannot follow them, or not now.
            NotConnectedError: the link broke.
        """
        await self._fresh.wait()
        self.session.require()
        wired = self._tracker.prepare(segments)
        try:
            await self.command(*wired)
        except BoardRefusedError:
            # it may have taken the ones before, so only it knows where its queue ends
            self._distrust()
            raise

    async def stop(self, make: MakeStop) -> None:
        """Send a stop until the board has heard it.

        Raises:
            NotConnectedError: the link broke before.
        """
        self._stops_under_way += 1
        self._distrust()
        try:
            await self.session.stop(make)
        finally:
            self._stops_under_way -= 1
            self._distrust()

    async def close(self, error: NotConnectedError) -> None:
        """End the session and close the port; whoever waits for an answer gets the error."""
        self.session.end(error)
        self._fresh.set()  # nobody waits for a sample any more
        await self._port.close()

    def _distrust(self) -> None:
        """What was known of the board's place is no longer true; the next sample tells anew."""
        self._tracker.forget()
        self._fresh.clear()

    def _take_sample(self, sample: messages.Telemetry, received_at_s: float) -> None:
        self.gauge.take(sample)
        clock = self.session.clock
        sampled_at_s = received_at_s
        if clock.known:
            sampled_at_s = min(clock.host_time_s(sample.tick), received_at_s)
        try:
            state = self._tracker.take(
                sample, sampled_at_s=sampled_at_s, received_at_s=received_at_s
            )
        except ValueError as error:
            self.session.lose(f"The board reports what this version does not know: {error}.")
            return
        if self._tracker.strayed:
            self._catch_stray(sample)
        if TelemetryFlag.KEPT_DAMAGED in TelemetryFlag(sample.flags) and not self._told_damage:
            self._told_damage = True
            _log.warning("the configuration in the board's EEPROM was damaged; it was sent anew")
        if not self._stops_under_way:
            self._fresh.set()
        self._on_state(state)

    def _catch_stray(self, sample: messages.Telemetry) -> None:
        _log.error("the board is not where its segments lead: %s", sample)
        if self._emergency is None or self._emergency.done():
            self._emergency = asyncio.create_task(self._stop_stray(), name="segment mismatch")

    async def _stop_stray(self) -> None:
        try:
            await self.stop(
                lambda token: messages.EmergencyStop(fault=Fault.SEGMENT_MISMATCH, token=token)
            )
        except NotConnectedError as error:
            # it stops by itself when its heartbeat is missing
            _log.error("the stop after a segment mismatch did not reach the board: %s", error)


def _identity(hello: messages.Hello) -> RobotIdentity:
    names = {int(kind): name for kind, name in BOARD_NAMES.items()}
    return RobotIdentity(
        name=names.get(hello.board, f"Board {hello.board}"),
        firmware=f"{hello.firmware_major}.{hello.firmware_minor}.{hello.firmware_patch}",
        queue_capacity=hello.queue_capacity,
        segment_s=hello.segment_ticks / hello.tick_hz,
    )


class _Switch:
    """Leads what comes from the port to the handshake first, then to the session."""

    def __init__(self) -> None:
        self.handshake: Handshake | None = None
        self.session: Session | None = None

    def hear(self, frames: list[Frame], received_s: float) -> None:
        if not frames and self.handshake is not None:
            self.handshake.hear_noise()
        for frame in frames:
            if self.session is not None:
                self.session.hear(frame, received_s)
            elif self.handshake is not None:
                self.handshake.hear(frame)

    def lose(self, words: str) -> None:
        if self.session is not None:
            self.session.lose(words)
        elif self.handshake is not None:
            self.handshake.lose(words)


async def connect_board(
    port: str,
    *,
    open_line: OpenLine,
    settings: BoardSettings,
    geometry: RobotGeometry,
    limits: MotionLimits,
    on_state: OnState,
    on_lost: OnLost,
    traffic: Traffic | None = None,
) -> Connection:
    """Find the board, open its port and make it ready for work.

    Args:
        port: Of the board, "auto" to look for it.
        open_line: Opens it.
        settings: Of the board.
        geometry: Gives the travel of the joints.
        limits: How fast they may move.
        on_state: Gets every sample.
        on_lost: Called once when the link has broken.
        traffic: Told what goes over the link.

    Raises:
        NotConnectedError: there is no board, it does not answer, or it is the wrong one.
        BoardRefusedError: it does not take its configuration.
    """
    device = await asyncio.to_thread(find_board, port)
    switch = _Switch()
    line = TappedLine(traffic or Traffic(), switch.hear)
    line.lay_on(await open_line(device, line.hear, switch.lose))
    try:
        switch.handshake = Handshake(line)
        hello = await switch.handshake.run()
        if hello.reset_cause == ResetCause.WATCHDOG:
            _log.error("the board's firmware hung and was restarted by its watchdog")
        elif hello.reset_cause == ResetCause.BROWN_OUT:
            _log.warning("the board's supply broke down; check its power supply and its cable")
        connection = Connection(
            line,
            hello,
            settings=settings,
            geometry=geometry,
            limits=limits,
            on_state=on_state,
            on_lost=on_lost,
        )
    except BaseException:
        await line.close()
        raise
    switch.session = connection.session
    try:
        await connection.configure()
        connection.session.require()
    except BaseException:
        await connection.close(NotConnectedError("The link was given up."))
        raise
    return connection
