"""One motion under way: a plan fed to the board segment by segment, with bounded look-ahead."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable

from drivers.robot import SEGMENT_NUMBERS, RobotIdentity, RobotState
from server.control.board import MOVING, Board
from server.control.built_robot import BuiltRobot, Step
from server.control.errors import MotionRefusedError
from server.control.finishing import finish
from twin.joints import JointAcceleration
from twin.motion import JointState, MotionPlan

CHANGEABLE_LOOK_AHEAD = 8
"""Segments kept in the board of a motion whose target may change: 160 ms. Any other motion fills
the board's queue, which rides out a busier computer."""

IN_TRANSIT_S = 0.01
"""A sample taken so soon after a push may not show it yet."""

ARRIVED_MM = 0.02

Watch = Callable[[RobotState], None]
"""Called with every sample while the motion runs; raising stops the motion."""

Replan = Callable[[JointState], MotionPlan]
"""Makes a plan from a state that may be in motion."""


class Motion:
    """A motion that is being executed. Made by the supervisor; ``run`` may be awaited once.

    Args:
        board: Executes it.
        identity: Of the board.
        plan: What to do.
        watch: Sees every sample while it runs.
        built: What the board's joints have to do for those of the plan.
        changeable: It may be retargeted on the way.
    """

    def __init__(
        self,
        board: Board,
        identity: RobotIdentity,
        plan: MotionPlan,
        watch: Watch | None,
        *,
        built: BuiltRobot,
        changeable: bool,
    ) -> None:
        self._board = board
        self._segment_s = identity.segment_s
        self._look_ahead = (
            min(CHANGEABLE_LOOK_AHEAD, identity.queue_capacity)
            if changeable
            else identity.queue_capacity
        )
        self._capacity = identity.queue_capacity
        self._watch = watch
        self._interruption: Exception | None = None
        self._sent = 0
        self._done_before: int | None = None
        self._pushed_at_s = 0.0
        self._push: asyncio.Task[None] | None = None
        self._built = built
        self._tail: Step | None = None
        self._plan = plan
        self._sent_of_plan_s = 0.0
        self._pending = deque(built.steps(plan, self._segment_s))

    @property
    def plan(self) -> MotionPlan:
        """The plan being followed."""
        return self._plan

    @property
    def last_leg(self) -> bool:
        """Too late to change the target: the board has, or is about to get, all there is."""
        return len(self._pending) <= self._look_ahead

    def interrupt(self, reason: Exception) -> None:
        """Make ``run`` stop the robot and raise ``reason`` at the next sample."""
        self._interruption = reason

    def retarget(self, replan: Replan) -> None:
        """Continue differently from the end of what the board already has."""
        plan = replan(self._tail_state())
        self._plan, self._sent_of_plan_s = plan, 0.0
        self._pending = deque(self._built.steps(plan, self._segment_s))

    async def run(self) -> RobotState:
        """Feed the board until the plan's end is reached; return the last sample.

        Whatever ends it early (interruption, a watch that raises, cancellation) stops the robot
        with category 2 and waits for its rest first.

        Raises:
            ControlError: the board refused, stopped by itself, or went offline.
        """
        try:
            state = self._board.telemetry.require()
            self._obey_interruption()
            while True:
                self._feed(state)
                known, state = state, await self._board.telemetry.newer_than(state)
                self._obey_interruption()
                self._look_at_push()
                if self._watch is not None:
                    for sample in self._board.telemetry.after(known):
                        self._watch(sample)
                if self._push is None and self._arrived(state):
                    return state
        except BaseException:
            await finish(self._stop())
            raise

    async def _stop(self) -> None:
        if self._push is not None:
            self._push.cancel()
            # What became of it does not matter any more: the queue is dropped.
            await asyncio.gather(self._push, return_exceptions=True)
        await self._board.come_to_rest()

    def _obey_interruption(self) -> None:
        if self._interruption is not None:
            raise self._interruption

    def _arrived(self, state: RobotState) -> bool:
        pushed_at_s = self._pushed_at_s
        if self._pending or state.board in MOVING or state.sampled_at_s <= pushed_at_s:
            return False
        end = self._tail.drawn.end if self._tail else self._plan.end.position
        missing_mm = max(abs(a - b) for a, b in zip(state.commanded.position, end, strict=True))
        if missing_mm < ARRIVED_MM:
            return True
        if state.sampled_at_s > pushed_at_s + IN_TRANSIT_S:
            raise MotionRefusedError(
                f"The motion board came to rest {missing_mm:.1f} mm before the end of the motion."
            )
        return False

    def _feed(self, state: RobotState) -> None:
        """Send what there is room for; a push takes long on a bad cable, and the watch goes on."""
        if self._push is not None:
            return
        not_done = self._sent - self._done(state)  # in the board, or on the way to it
        ahead = max(not_done - self._done_since(state), 0)
        room = min(self._look_ahead - ahead, self._capacity - not_done)
        if room <= 0 or not self._pending:
            return
        batch = [self._pending.popleft() for _ in range(min(room, len(self._pending)))]
        self._tail = batch[-1]
        self._sent += len(batch)
        self._sent_of_plan_s += sum(step.drawn.duration_s for step in batch)
        self._push = asyncio.create_task(self._send(batch), name="push segments")

    async def _send(self, batch: list[Step]) -> None:
        await self._board.push([step.board for step in batch], drawn=[step.drawn for step in batch])
        self._pushed_at_s = asyncio.get_running_loop().time()

    def _look_at_push(self) -> None:
        if self._push is not None and self._push.done():
            push, self._push = self._push, None
            push.result()

    def _done_since(self, state: RobotState) -> int:
        """Segments that the board has finished for certain since it took a sample."""
        if self._tail is None:
            return 0
        age_s = asyncio.get_running_loop().time() - state.sampled_at_s
        return int(age_s / self._tail.drawn.duration_s)

    def _done(self, state: RobotState) -> int:
        """Segments of this motion that the board had finished at a sample."""
        if self._done_before is None:
            self._done_before = state.segments_done
        return (state.segments_done - self._done_before) % SEGMENT_NUMBERS

    def _tail_state(self) -> JointState:
        if self._tail is None:
            return self._plan.start
        at_rest = self._sent_of_plan_s >= self._plan.duration_s - 1e-9
        position, velocity = self._built.tail(self._tail)
        return JointState(
            position,
            velocity,
            JointAcceleration(0.0, 0.0, 0.0)
            if at_rest
            else self._plan.acceleration_at(self._sent_of_plan_s),
        )
