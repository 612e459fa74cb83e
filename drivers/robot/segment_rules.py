"""What a motion board accepts as a continuation of its queue."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from drivers.robot.errors import BoardRefusedError
from twin.geometry import JointRange
from twin.joints import JointPosition, JointVelocity
from twin.motion.limits import JointLimits
from twin.motion.segments import Segment

JOINTS = ("rho1", "rho2", "rho3")

Objection = tuple[str, str]
"""Stable name of a reason, and the sentence."""

DURATION_TOLERANCE = 1e-6
"""A plan cut into equal parts may round up."""


@dataclass(frozen=True, slots=True)
class SegmentRules:
    """The rules of one board.

    Attributes:
        travel: Of rho1, rho2, rho3.
        limits: Of rho1, rho2, rho3.
        longest_s: Longest duration of a segment [s].
        position_tolerance_mm: Jump between two segments that is only rounding.
        velocity_tolerance_mm_s: The same for velocities.
        limit_tolerance_mm: Excess over the travel that is only rounding.
        speed_tolerance: Excess over the velocity limits accepted, relative.
    """

    travel: tuple[JointRange, JointRange, JointRange]
    limits: tuple[JointLimits, JointLimits, JointLimits]
    longest_s: float
    position_tolerance_mm: float
    velocity_tolerance_mm_s: float
    limit_tolerance_mm: float
    speed_tolerance: float

    def check(
        self, segments: Sequence[Segment], position: JointPosition, velocity: JointVelocity
    ) -> None:
        """Do nothing if the board can follow the segments.

        Args:
            segments: To be appended.
            position: Where the queue ends.
            velocity: How fast it ends.

        Raises:
            BoardRefusedError: a segment is longer than the board's, does not begin where the one
                before it ends, leaves the travel or is too fast; the message says which and why.
        """
        for number, segment in enumerate(segments):
            objection = (
                self._bad_number(segment)
                or self._gap(segment, position, velocity)
                or self._beyond_travel(segment)
                or self._too_fast(segment)
            )
            if objection:
                reason, words = objection
                raise BoardRefusedError(f"Segment {number} was refused: {words}.", reason)
            position, velocity = segment.end, segment.end_velocity

    def _bad_number(self, segment: Segment) -> Objection | None:
        numbers = (segment.duration_s, *segment.start, *segment.velocity, *segment.acceleration)
        if not all(math.isfinite(number) for number in numbers):
            return "bad_value", "it contains a number that is not finite"
        if not 0 < segment.duration_s <= self.longest_s * (1 + DURATION_TOLERANCE):
            return (
                "bad_ticks",
                f"it lasts {segment.duration_s:g} s; the board takes up to {self.longest_s:g} s",
            )
        return None

    def _gap(
        self, segment: Segment, position: JointPosition, velocity: JointVelocity
    ) -> Objection | None:
        for joint, q, end, v, end_v in zip(
            JOINTS, segment.start, position, segment.velocity, velocity, strict=True
        ):
            if abs(q - end) > self.position_tolerance_mm:
                return "discontinuous", f"{joint} jumps by {q - end:.4f} mm"
            if abs(v - end_v) > self.velocity_tolerance_mm_s:
                return "rate_jump", f"the velocity of {joint} jumps by {v - end_v:.2f} mm/s"
        return None

    def _beyond_travel(self, segment: Segment) -> Objection | None:
        for joint, q, travel in zip(JOINTS, segment.end, self.travel, strict=True):
            if abs(travel.excess_mm(q)) > self.limit_tolerance_mm:
                return "beyond_travel", f"{joint} would go to {q:.3f} mm, beyond its travel"
        return None

    def _too_fast(self, segment: Segment) -> Objection | None:
        for joint, v, end_v, limits in zip(
            JOINTS, segment.velocity, segment.end_velocity, self.limits, strict=True
        ):
            speed_mm_s = max(abs(v), abs(end_v))
            if speed_mm_s > limits.velocity_mm_s * (1 + self.speed_tolerance):
                return (
                    "too_fast",
                    f"{joint} would move at {speed_mm_s:.1f} mm/s; "
                    f"it can do {limits.velocity_mm_s:g}",
                )
        return None
