"""Follows the board along the segments it was sent, step by step."""

from __future__ import annotations

from collections.abc import Sequence

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import State, TelemetryFlag
from drivers.arduino.queue_line import STILL, QueueLine
from drivers.arduino.scale import AxisScale
from drivers.arduino.steps import (
    WirePoint,
    nearest_within_unit,
    segment_end,
    ticks_of,
    wire_segment,
)
from drivers.arduino.telemetry import robot_state
from drivers.arduino.words import STATES
from drivers.robot import BoardRefusedError, NotConnectedError, QueueFullError, RobotState
from drivers.robot.segment_rules import SegmentRules
from twin.joints import JointPosition, JointVelocity
from twin.motion.segments import Segment

ON_THE_LINE = {State.RUN, State.READY}
"""States in which the segments decide where the board is."""

_WHY_NO_MOTION = {
    State.HOMING: ("homing", "the robot is homing"),
    State.STOPPING: ("stopping", "the robot is still stopping"),
    State.RUN: ("moving", "the robot is still moving"),
    State.FAULT: ("fault_latched", "a fault is latched and the robot still moves"),
}
"""Stable names of the reasons, and the sentences."""


class Tracker:
    """Knows where the board is, and turns segments into the board's integers.

    Args:
        scales: Of the three axes.
        rules: What the board accepts.
        queue_capacity: Segments it can hold.
    """

    def __init__(
        self, scales: Sequence[AxisScale], rules: SegmentRules, queue_capacity: int
    ) -> None:
        self._scales = scales
        self._rules = rules
        self._capacity = queue_capacity
        self._line = QueueLine()
        self._sample: messages.Telemetry | None = None
        self.strayed = False

    def take(
        self, sample: messages.Telemetry, *, sampled_at_s: float, received_at_s: float
    ) -> RobotState:
        """Take a sample; ``strayed`` tells then whether it contradicts the segments.

        Raises:
            ValueError: the board reports a state or fault that this version does not know.
        """
        self._sample = sample
        if sample.state not in ON_THE_LINE and not self._line.untouched(sample):
            self._line.forget()
        self.strayed = sample.state in ON_THE_LINE and self._line.contradicts(sample)
        point = None if self.strayed else self._line.expected(sample)
        return robot_state(
            sample,
            point,
            self._scales,
            sampled_at_s=sampled_at_s,
            received_at_s=received_at_s,
            queue_capacity=self._capacity,
        )

    @property
    def running(self) -> bool:
        """The newest sample shows the board following segments."""
        return self._sample is not None and self._sample.state == State.RUN

    def forget(self) -> None:
        """The board has been told to leave its line, or has refused a part of it."""
        self._line.forget()

    def prepare(self, segments: Sequence[Segment]) -> list[messages.Segment]:
        """The messages of some segments, which are then expected to be sent; all or none.

        Raises:
            QueueFullError: they do not fit.
            BoardRefusedError: the board cannot follow them, or moves in another way just now.
        """
        sample = self._require_sample()
        end = self._line.end or self._standstill(sample, segments[0])
        # a line that is only about to begin has nothing in the board
        waiting = self._line.in_board(sample) if self._line.end is not None else 0
        free = self._capacity - waiting
        if len(segments) > free:
            raise QueueFullError(f"{len(segments)} segments were pushed into {free} free places.")
        self._rules.check(segments, *self._in_mm(end))
        for number, segment in enumerate(segments):
            if ticks_of(segment.duration_s) > messages.MAX_SEGMENT_TICKS:
                raise BoardRefusedError(
                    f"Segment {number} was refused: it is too long.", "bad_ticks"
                )
        if self._line.end is None:
            self._line.begin(end.position, sample.next_segment)
        wired: list[messages.Segment] = []
        for segment in segments:
            wire = wire_segment(segment, self._line.next_number, end.position, self._scales)
            self._line.append(wire)
            wired.append(wire)
            end = segment_end(wire)
        return wired

    def _require_sample(self) -> messages.Telemetry:
        if self._sample is None:
            raise NotConnectedError("The board has not reported yet where it is.")
        return self._sample

    def _standstill(self, sample: messages.Telemetry, first: Segment) -> WirePoint:
        """Where the board rests. It knows whole steps only: the plan chooses the part of a step."""
        moving = TelemetryFlag.MOVING in TelemetryFlag(sample.flags)
        state = State(sample.state)
        if moving or state in {State.HOMING, State.STOPPING, State.RUN}:
            otherwise = ("moving", f"the board is still moving ({STATES[state].value})")
            reason, words = _WHY_NO_MOTION.get(state, otherwise)
            raise BoardRefusedError(f"No motion is possible: {words}.", reason)
        one, two, three = (
            nearest_within_unit(scale.position(mm), units)
            for scale, mm, units in zip(self._scales, first.start, sample.commanded, strict=True)
        )
        return WirePoint((one, two, three), STILL)

    def _in_mm(self, point: WirePoint) -> tuple[JointPosition, JointVelocity]:
        scales = self._scales
        return (
            JointPosition(*(s.mm(p) for s, p in zip(scales, point.position, strict=True))),
            JointVelocity(*(s.mm_s(r) for s, r in zip(scales, point.rate, strict=True))),
        )
