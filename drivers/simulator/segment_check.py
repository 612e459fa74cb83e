"""What the simulated board accepts as a continuation of its queue."""

from __future__ import annotations

from collections.abc import Sequence

from drivers.robot.segment_rules import JOINTS, SegmentRules
from drivers.simulator.world import SimulatedWorld
from twin.joints import JointPosition, JointVelocity
from twin.motion.segments import Segment

__all__ = ["JOINTS", "check_segments"]


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
        BoardRefusedError: it cannot; see ``SegmentRules.check``.
    """
    board = world.parameters.board
    rules = SegmentRules(
        travel=world.geometry.joint_ranges,
        limits=world.limits.joints,
        longest_s=board.segment_s,
        position_tolerance_mm=board.position_tolerance_mm,
        velocity_tolerance_mm_s=board.velocity_tolerance_mm_s,
        limit_tolerance_mm=board.limit_tolerance_mm,
        speed_tolerance=board.speed_tolerance,
    )
    rules.check(segments, position, velocity)
