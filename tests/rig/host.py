"""What a host does with the real driver: bring the board up, move, and watch."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence

from drivers.arduino.driver import ArduinoRobot
from drivers.robot import BoardRefusedError, BoardState, RobotState
from tests.support.eventually import eventually
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
    loop = asyncio.get_running_loop()
    waiting = list(segments)
    pushed_s = loop.time()
    async for state in robot.telemetry():
        if state.fault is not None:
            return state
        if state.sampled_at_s <= pushed_s:
            continue  # knows nothing of the last push
        if waiting:
            batch, waiting = waiting[: state.queue_free], waiting[state.queue_free :]
            await robot.push(batch)
            pushed_s = loop.time()
        elif state.board not in MOVING:
            return state
    raise AssertionError("the telemetry ended")


async def release(robot: ArduinoRobot) -> None:
    """Clear a fault as soon as the board has come to rest."""

    async def cleared() -> bool:
        try:
            await robot.clear_fault()
        except BoardRefusedError:
            return False
        return True

    await eventually(cleared)


async def move(robot: ArduinoRobot, limits: MotionLimits, target: JointPosition) -> RobotState:
    """Go there and wait for rest, or stop at a fault."""
    return await feed(robot, await plan(robot, limits, target))
