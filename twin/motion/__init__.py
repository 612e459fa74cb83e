"""Motion planning: jerk-limited plans, their check, and the segments that a board follows."""

from twin.motion.check import check_plan
from twin.motion.discretise import plan_segments
from twin.motion.errors import (
    InvalidMotionError,
    MotionError,
    PlanningError,
    UnsafePlanError,
)
from twin.motion.from_below import plan_from_below
from twin.motion.limits import JointLimits, MotionLimits
from twin.motion.plan import JointState, MotionPlan, MotionSamples
from twin.motion.point_to_point import JointPlan, minimum_time_s, plan_joint_move
from twin.motion.segments import Segment
from twin.motion.stop import plan_stop
from twin.motion.straight_line import StraightLinePlan, plan_straight_line

__all__ = [
    "InvalidMotionError",
    "JointLimits",
    "JointPlan",
    "JointState",
    "MotionError",
    "MotionLimits",
    "MotionPlan",
    "MotionSamples",
    "PlanningError",
    "Segment",
    "StraightLinePlan",
    "UnsafePlanError",
    "check_plan",
    "minimum_time_s",
    "plan_from_below",
    "plan_joint_move",
    "plan_segments",
    "plan_stop",
    "plan_straight_line",
]
