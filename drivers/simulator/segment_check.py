"""What the simulated board accepts as a continuation of its queue."""

from __future__ import annotations

import math
from collections.abc import Sequence

from drivers.robot import BoardRefusedError
from drivers.simulator.world import SimulatedWorld
from twin.joints import JointPosition, JointVelocity
from twin.motion.segments import Segment

JOINTS = ("rho1", "rho2", "rho3")


def check_segments(
    segments: Sequence[Segment],
    position: JointPosition,
    velocity: JointVelocity,
    world: SimulatedWorld,
) -> None:
    """Do nothing if the board can follow the segments.

    Args:
        segments: To be appended.
        position: Where the queue ends.
        velocity: How fast it ends.
        world: Knows travel, limits and tolerances.

    Raises:
        BoardRefusedError: a segment is longer than the board's, does not begin where the one
            before it ends, leaves the travel or is too fast; the message says which one and why.
    """
    for number, segment in enumerate(segments):
        reason = (
            _bad_number(segment, world)
            or _gap(segment, position, velocity, world)
            or _beyond_travel(segment, world)
            or _too_fast(segment, world)
        )
        if reason:
            raise BoardRefusedError(f"Segment {number} was refused: {reason}.")
        position, velocity = segment.end, segment.end_velocity


def _bad_number(segment: Segment, world: SimulatedWorld) -> str | None:
    numbers = (segment.duration_s, *segment.start, *segment.velocity, *segment.acceleration)
    if not all(math.isfinite(number) for number in numbers):
        return "it contains a number that is not finite"
    longest_s = world.parameters.board.segment_s
    # a plan cut into equal parts may round up
    if not 0 < segment.duration_s <= longest_s * (1 + 1e-6):
        return f"it lasts {segment.duration_s:g} s; the board takes up to {longest_s:g} s"
    return None


def _gap(
    segment: Segment, position: JointPosition, velocity: JointVelocity, world: SimulatedWorld
) -> str | None:
    board = world.parameters.board
    for joint, q, end, v, end_v in zip(
        JOINTS, segment.start, position, segment.velocity, velocity, strict=True
    ):
        if abs(q - end) > board.position_tolerance_mm:
            return f"{joint} jumps by {q - end:.4f} mm"
        if abs(v - end_v) > board.velocity_tolerance_mm_s:
            return f"the velocity of {joint} jumps by {v - end_v:.2f} mm/s"
    return None


def _beyond_travel(segment: Segment, world: SimulatedWorld) -> str | None:
    for joint, q, travel in zip(JOINTS, segment.end, world.geometry.joint_ranges, strict=True):
        if abs(travel.excess_mm(q)) > world.parameters.board.limit_tolerance_mm:
            return f"{joint} would go to {q:.3f} mm, beyond its travel"
    return None


def _too_fast(segment: Segment, world: SimulatedWorld) -> str | None:
    for joint, v, end_v, limits in zip(
        JOINTS, segment.velocity, segment.end_velocity, world.limits.joints, strict=True
    ):
        speed_mm_s = max(abs(v), abs(end_v))
        if speed_mm_s > limits.velocity_mm_s * (1 + world.parameters.board.speed_tolerance):
            return (
                f"{joint} would move at {speed_mm_s:.1f} mm/s; it can do {limits.velocity_mm_s:g}"
            )
    return None
