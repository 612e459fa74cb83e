"""What a host does with the real driver: bring the board up, move, and watch."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable, Sequence

from drivers.arduino.driver import ArduinoRobot
from drivers.robot import BoardRefusedError, BoardState, RobotState
from tests.rig.rig import Rig
from tests.support.eventually import eventually
from twin.joints import JointPosition
from twin.motion import MotionLimits
from twin.motion.discretise import plan_segments
from twin.motion.point_to_point import plan_joint_move
from twin.motion.segments import Segment

LIMITS = MotionLimits()
NEAR = JointPosition(140.0, 160.0, 60.0)
FAR = JointPosition(190.0, 120.0, 80.0)

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
    robot: ArduinoRobot, target: JointPosition, limits: MotionLimits = LIMITS
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


async def move(
    robot: ArduinoRobot, target: JointPosition, limits: MotionLimits = LIMITS
) -> RobotState:
    """Go there and wait for rest, or stop at a fault."""
    return await feed(robot, await plan(robot, target, limits))


async def ready(rig: Rig, robot: ArduinoRobot, at: JointPosition) -> None:
    """The robot stands somewhere, enabled, homed and without a fault."""
    state = await at_rest(robot)
    if state.fault is not None:
        await release(robot)
    await robot.enable()
    if not state.homed:
        await robot.home()
    await robot.set_force_limit(90.0)
    assert (await move(robot, at)).fault is None
    await rig.control.forget()


@contextlib.asynccontextmanager
async def on_the_way(
    robot: ArduinoRobot, target: JointPosition, limits: MotionLimits = LIMITS
) -> AsyncIterator[None]:
    """Moving there, well after the start; the feeding of segments ends with the block."""
    feeding = asyncio.create_task(feed(robot, await plan(robot, target, limits)))
    try:
        await sample_where(robot, lambda state: state.board is BoardState.RUN)
        await asyncio.sleep(0.2)  # up to speed
        yield
    finally:
        feeding.cancel()
        await asyncio.wait([feeding])
        if not feeding.cancelled():
            feeding.exception()
