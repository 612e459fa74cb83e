"""What a host does with the real driver: bring the board up, move, and watch."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from drivers.arduino.driver import ArduinoRobot
from drivers.robot import BoardState, RobotState
from twin.joints import JointPosition
from twin.motion import MotionLimits
from twin.motion.discretise import plan_segments
from twin.motion.point_to_point import plan_joint_move
from twin.motion.segments import Segment

MOVING = {BoardState.RUN, BoardState.STOPPING, BoardState.HOMING}


async def sample_where(robot: ArduinoRobot, fits: Callable[[RobotState], bool]) -> RobotState:
    """The first sample from now on that fits."""
    async for state in robot.telemetry():
        if fits(state):
            return state
    raise AssertionError("the telemetry ended")


async def at_rest(robot: ArduinoRobot) -> RobotState:
    """The first sample from now on in which nothing moves."""
    return await sample_where(robot, lambda state: state.board not in MOVING)


async def plan(
    robot: ArduinoRobot, limits: MotionLimits, target: JointPosition
) -> Sequence[Segment]:
    """A plan from rest, cut for the board."""
    start = (await at_rest(robot)).commanded.position
    return plan_segments(plan_joint_move(limits, start, target))


async def feed(robot: ArduinoRobot, segments: Sequence[Segment]) -> RobotState:
    """Keep the board's queue filled until all is pushed; returns at rest or at a fault."""
    waiting = list(segments)
    pushed = False
    async for state in robot.telemetry():
        if state.fault is not None:
            return state
        # two places less than the sample shows: it is older than the queue
        room = max(state.queue_free - 2, 0)
        if waiting and room:
            batch, waiting = waiting[:room], waiting[room:]
            await robot.push(batch)
            pushed = True
        elif pushed and not waiting and state.board not in MOVING:
            return state
    raise AssertionError("the telemetry ended")


async def move(robot: ArduinoRobot, limits: MotionLimits, target: JointPosition) -> RobotState:
    """Go there and wait for rest, or stop at a fault."""
    return await feed(robot, await plan(robot, limits, target))
