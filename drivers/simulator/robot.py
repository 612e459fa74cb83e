"""The simulated robot behind the robot protocol: a board at the end of a cable."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncIterator, Callable, Sequence
from dataclasses import replace

from drivers.robot import (
    BoardRefusedError,
    NotConnectedError,
    RobotDriverError,
    RobotIdentity,
    RobotState,
    StopCategory,
)
from drivers.robot.link_health import LinkHealth, RoundTrip
from drivers.robot.telemetry_feed import TelemetryFeed
from drivers.robot.traffic import Traffic
from drivers.simulator.board import SimulatedBoard
from drivers.simulator.homing import HomingRoutine
from drivers.simulator.telling import (
    command_passage,
    refusal_passage,
    sample_passage,
    segments_words,
)
from drivers.simulator.world import SimulatedWorld
from twin.motion.segments import Segment

Action = Callable[[float], None]
"""What a command does on the board, given the time at which it arrives."""


class SimulatedRobot:
    """Implements RobotDriver on a simulated world, link delays and faults included.

    Args:
        world: What the robot stands in.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self.traffic = Traffic()
        self._world = world
        self._numbers = world.parameters.board
        self._board = SimulatedBoard(world)
        self._feed = TelemetryFeed()
        self._in_flight: deque[RobotState] = deque()
        self._delivered: RobotState | None = None
        self._wake = asyncio.Event()
        self._board_task: asyncio.Task[None] | None = None
        self._homing_task: asyncio.Task[None] | None = None
        self._cable = True
        self._linked = False
        self._links = 0

    # --- RobotDriver -------------------------------------------------------------------------

    async def connect(self) -> RobotIdentity:
        """Open the link and wait until the board has started.

        Raises:
            NotConnectedError: the cable is unplugged.
        """
        if not self._cable:
            await asyncio.sleep(self._numbers.link_timeout_s)
            raise NotConnectedError("The board does not answer; check the USB cable.")
        if self._board_task is None:
            await asyncio.sleep(self._numbers.boot_s)
            self._board.finish_boot(self._now())
            self._board_task = asyncio.create_task(self._run_board(), name="simulated board")
        self._open_link()
        return RobotIdentity(
            name="Simulator",
            firmware="simulated",
            queue_capacity=self._numbers.queue_capacity,
            segment_s=self._numbers.segment_s,
        )

    async def close(self) -> None:
        """Stop the motion (category 1) and close the link. Safe to call twice."""
        task, self._board_task = self._board_task, None
        if task is None:
            return
        self._linked = False
        self._board.stop(StopCategory.DECELERATE_AND_RELEASE, self._now())
        while self._board.moving:
            await asyncio.sleep(self._numbers.moving_period_s)
            self._board.sync(self._now())
        if self._homing_task is not None:
            await asyncio.wait([self._homing_task])
        task.cancel()
        await asyncio.wait([task])
        self._feed.close()

    def telemetry(self) -> AsyncIterator[RobotState]:
        """Every sample from now on; ends when the link is lost or closed.

        Raises:
            NotConnectedError: there is no link.
        """
        self._require_link()
        return self._feed.subscribe()

    async def enable(self) -> None:
        """Energise the drives."""
        await self._send("Enable", self._board.enable)

    async def disable(self) -> None:
        """De-energise the drives; refused while moving."""
        await self._send("Disable", self._board.disable)

    async def home(self) -> None:
        """Seek the limit switches and set the positions; returns when done.

        The routine runs on the board: it goes on if the caller stops waiting.
        """
        await self._send("Home", self._begin_homing)
        if self._homing_task is None:
            raise BoardRefusedError("Homing did not begin.")
        try:
            await asyncio.shield(self._homing_task)
        except RobotDriverError as error:
            if not (self._linked and self._cable):
                raise NotConnectedError("The link was lost during homing.") from error
            raise

    async def set_force_limit(self, force_n: float) -> None:
        """Cap the force of the rho3 actuator [N]; the board enforces it by itself."""
        words = f"force_n={force_n:g}"
        await self._send(
            "ForceLimit", lambda now_s: self._board.set_force_limit(force_n, now_s), lambda: words
        )

    async def push(self, segments: Sequence[Segment]) -> None:
        """Append segments to the board's queue; all or none."""
        taken = tuple(segments)
        await self._send(
            "Segment",
            lambda now_s: self._board.push(taken, now_s),
            lambda: segments_words(taken),
        )

    async def stop(self, category: StopCategory) -> None:
        """Drop the queue and decelerate; honoured in every state, idempotent."""
        await self._send(
            "Stop", lambda now_s: self._board.stop(category, now_s), lambda: category.name
        )

    async def emergency_stop(self) -> None:
        """Category 1 stop, then latch EMERGENCY_STOP."""
        await self._send("EmergencyStop", self._board.emergency_stop)

    async def clear_fault(self) -> None:
        """Release a latched fault whose cause is gone."""
        await self._send("ClearFault", self._board.clear_fault)

    # --- TellsLinkHealth ---------------------------------------------------------------------

    def link_health(self) -> LinkHealth:
        """The link as it is modelled: commands and answers take a fixed time.

        There are no frames that could be counted or damaged, and the supply is not modelled.
        """
        linked = self._linked and self._cable
        there_and_back_s = [2 * self._numbers.command_delay_s] if linked else []
        return LinkHealth(max(self._links - 1, 0), RoundTrip.of(there_and_back_s))

    # --- fault injection ---------------------------------------------------------------------

    def unplug_link(self) -> None:
        """Pull the USB cable: the board stops by itself, the driver notices the silence."""
        self._cable = False
        loop = asyncio.get_running_loop()
        loop.call_later(self._numbers.heartbeat_timeout_s, self._miss_heartbeats)
        loop.call_later(self._numbers.link_timeout_s, self._notice_silence)

    def replug_link(self) -> None:
        """Put the cable back: the driver reconnects by itself after a moment."""
        self._cable = True
        loop = asyncio.get_running_loop()
        loop.call_later(self._numbers.reconnect_s, self._reconnect)

    def jam(self) -> None:
        """Block the slide where it stands."""
        self._world.jam_slide(self._now())

    def free_jam(self) -> None:
        """Take away what blocks the slide."""
        self._world.free_slide(self._now())
        self._wake.set()

    def press_stop_button(self) -> None:
        """Press the emergency-stop button, which also cuts the power of the motors."""
        self._board.press_stop_button(self._now(), pressed=True)
        self._wake.set()

    def release_stop_button(self) -> None:
        """Turn the emergency-stop button until it springs out."""
        self._board.press_stop_button(self._now(), pressed=False)
        self._wake.set()

    def trip_limit(self, joint: int = 0) -> None:
        """Cut the wire of a limit switch: 0, 1, 2 for rho1, rho2, rho3."""
        self._board.cut_switch(joint, cut=True)

    def mend_limit(self, joint: int = 0) -> None:
        """Mend the wire of a limit switch."""
        self._board.cut_switch(joint, cut=False)

    # --- the board's own life ----------------------------------------------------------------

    async def _run_board(self) -> None:
        """Keep the board up to date and send its telemetry."""
        due_s = self._now()
        while True:
            self._wake.clear()
            now_s = self._now()
            if self._cable:
                self._transmit(self._board.sample(now_s))
            else:
                self._board.sync(now_s)
            if self._board.moving:
                # a fixed grid: the rate stays right although timers fire late
                due_s = max(due_s, now_s - self._numbers.moving_period_s)
                due_s += self._numbers.moving_period_s
                await asyncio.sleep(due_s - now_s)
            else:
                due_s = now_s + self._numbers.rest_period_s
                await self._sleep_until_woken(due_s)
                due_s = self._now()

    async def _sleep_until_woken(self, until_s: float) -> None:
        try:
            async with asyncio.timeout_at(until_s):
                await self._wake.wait()
        except TimeoutError:
            return

    def _transmit(self, sample: RobotState) -> None:
        jitter_s = self._numbers.telemetry_jitter_s
        delay_s = self._numbers.telemetry_delay_s + float(
            self._world.streams.telemetry.uniform(-jitter_s, jitter_s)
        )
        self._in_flight.append(sample)
        asyncio.get_running_loop().call_later(delay_s, self._deliver)

    def _deliver(self) -> None:
        # a cable never changes the order
        sample = self._in_flight.popleft()
        if self._cable and self._linked:
            now_s = self._now()
            if self.traffic.heard:
                self.traffic.tell(sample_passage(sample, self._delivered, now_s))
            self._delivered = sample
            self._feed.publish(replace(sample, received_at_s=now_s))

    async def _send(self, kind: str, action: Action, words: Callable[[], str] = str) -> None:
        """Send a command; once on its way it takes effect even if the caller is cancelled."""
        self._require_link()
        if self.traffic.heard:
            self.traffic.tell(command_passage(kind, words(), self._now()))
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[None] = loop.create_future()
        loop.call_later(self._numbers.command_delay_s, self._arrive, action, answer)
        try:
            await answer
        except RobotDriverError as refusal:
            self.traffic.tell(refusal_passage(kind, refusal, self._now()))
            raise

    def _arrive(self, action: Action, answer: asyncio.Future[None]) -> None:
        refusal: RobotDriverError | None = None
        if self._cable and self._board_task is not None:
            try:
                action(self._now())
            except RobotDriverError as error:
                refusal = error
            self._wake.set()
        loop = asyncio.get_running_loop()
        loop.call_later(self._numbers.command_delay_s, self._answer, answer, refusal)

    def _answer(self, answer: asyncio.Future[None], refusal: RobotDriverError | None) -> None:
        if answer.done():
            return
        if not self._cable or self._board_task is None:
            refusal = NotConnectedError("The link broke before the board answered.")
        if refusal is None:
            answer.set_result(None)
        else:
            answer.set_exception(refusal)

    def _begin_homing(self, now_s: float) -> None:
        self._board.begin_homing(now_s)
        self._homing_task = asyncio.create_task(HomingRoutine(self._board).run(), name="homing")
        # whoever called home() may have given up; the board's own words are in its fault
        self._homing_task.add_done_callback(lambda task: task.cancelled() or task.exception())

    def _miss_heartbeats(self) -> None:
        if not self._cable:
            self._board.link_lost(self._now())
            self._wake.set()

    def _notice_silence(self) -> None:
        if not self._cable:
            self._linked = False
            self._feed.close()

    def _reconnect(self) -> None:
        if self._cable and self._board_task is not None:
            self._open_link()

    def _open_link(self) -> None:
        self._links += not self._linked
        self._linked = True

    def _require_link(self) -> None:
        if not (self._linked and self._cable):
            raise NotConnectedError("There is no link to the board.")

    @staticmethod
    def _now() -> float:
        return asyncio.get_running_loop().time()
