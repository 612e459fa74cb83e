"""Driving a robot at the end of a fake cable."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.settings import BoardSettings
from drivers.robot import BoardState, RobotState
from tests.support.board_cable import BoardCable
from twin.geometry import RobotGeometry
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion import MotionLimits, Segment, plan_joint_move, plan_segments

GEOMETRY = RobotGeometry()
LIMITS = MotionLimits()
WITHIN_S = 5.0
HOME = JointPosition(150, 150, 50)
STILL = Segment(0.02, HOME, JointVelocity(0, 0, 0), JointAcceleration(0, 0, 0))


def robot_at(cable: BoardCable) -> ArduinoRobot:
    return ArduinoRobot(str(cable.device), GEOMETRY, LIMITS, BoardSettings())


async def until(robot: ArduinoRobot, condition: Callable[[RobotState], bool]) -> RobotState:
    async with asyncio.timeout(WITHIN_S):
        async for state in robot.telemetry():
            if condition(state):
                return state
    raise AssertionError("the telemetry ended")


async def move(robot: ArduinoRobot, target: JointPosition) -> list[RobotState]:
    """Feed a whole move as the server does, and return all samples on the way."""
    start = (await until(robot, lambda s: s.board is BoardState.READY)).commanded.position
    pending = plan_segments(plan_joint_move(LIMITS, start, target), 0.02)
    samples: list[RobotState] = []
    reader = robot.telemetry()
    await robot.push(pending[:8])
    del pending[:8]
    pushed_s = asyncio.get_running_loop().time()
    async with asyncio.timeout(WITHIN_S):
        async for state in reader:
            samples.append(state)
            if state.fault is not None:
                return samples
            room = min(state.queue_free - 8, len(pending))
            if room > 0 and state.sampled_at_s > pushed_s:
                await robot.push(pending[:room])
                del pending[:room]
                pushed_s = asyncio.get_running_loop().time()
            ended = state.board is BoardState.READY and state.sampled_at_s > pushed_s
            if ended and not pending:
                return samples
    raise AssertionError("the telemetry ended")
