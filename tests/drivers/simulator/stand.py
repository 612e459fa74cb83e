"""A test stand: one simulated garage in virtual time, and a host that moves its robot."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from typing import Any, TypeVar

from drivers.camera import pi_camera_v2
from drivers.robot import BoardState, RobotState
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.truth import lateral_at_face_mm
from server.timing import VirtualTimeLoop
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma
from twin.motion.discretise import plan_segments
from twin.motion.limits import MotionLimits
from twin.motion.point_to_point import plan_joint_move
from twin.motion.segments import Segment

T = TypeVar("T")

GEOMETRY = RobotGeometry()
LIMITS = MotionLimits()
LONGEST_SCENARIO_S = 3000.0


def changed(parameters: SimulationParameters, group: str, **values: Any) -> SimulationParameters:  # noqa: ANN401 - any field
    """Parameters with some numbers of one group replaced, validated."""
    old = dict(getattr(parameters, group))
    new = type(getattr(parameters, group)).model_validate({**old, **values})
    return parameters.model_copy(update={group: new})


HOMED = changed(SimulationParameters(), "board", start_homed=True)
PERFECT = changed(SimulationParameters.perfect(), "board", start_homed=True)


class Stand:
    """A connected, enabled robot in a garage."""

    def __init__(self, garage: SimulatedGarage) -> None:
        self.garage = garage
        self.robot = garage.robot
        self.world = garage.world
        self.station = garage.station
        self.samples: list[RobotState] = []

    @property
    def now_s(self) -> float:
        return asyncio.get_running_loop().time()

    async def state(self) -> RobotState:
        """The first telemetry sample taken from now on."""
        now_s = self.now_s
        async for state in self.robot.telemetry():
            if state.sampled_at_s >= now_s:
                return state
        raise AssertionError("the telemetry ended")

    async def rest(self) -> RobotState:
        """The first sample from now on in which the board no longer moves."""
        now_s = self.now_s
        async for state in self.robot.telemetry():
            self.samples.append(state)
            if state.sampled_at_s >= now_s and state.board not in {
                BoardState.RUN,
                BoardState.STOPPING,
                BoardState.HOMING,
            }:
                return state
        raise AssertionError("the telemetry ended")

    async def segments_to(
        self, target: JointPosition, speed_fraction: float = 1.0
    ) -> list[Segment]:
        """A plan from rest, cut for the board."""
        start = (await self.state()).commanded.position
        return plan_segments(plan_joint_move(LIMITS.scaled(speed_fraction), start, target))

    async def feed(self, segments: Sequence[Segment]) -> RobotState:
        """Keep the queue filled until all is pushed; then wait for rest, or stop at a fault."""
        waiting = list(segments)
        telemetry = self.robot.telemetry()
        async for state in telemetry:
            self.samples.append(state)
            if state.fault is not None:
                return state
            # two places less than the sample shows: it is older than the queue
            room = max(state.queue_free - 2, 0)
            if waiting and room:
                batch, waiting = waiting[:room], waiting[room:]
                await self.robot.push(batch)
            elif not waiting and state.board is not BoardState.RUN:
                return state
        raise AssertionError("the telemetry ended")

    async def move(self, target: JointPosition, speed_fraction: float = 1.0) -> RobotState:
        """Go there and wait for rest, or stop at a fault."""
        return await self.feed(await self.segments_to(target, speed_fraction))

    async def align(self, gap_mm: float = 8.0, off_mm: float = 0.0) -> JointPosition:
        """Stand in front of the socket, the plug's axis off its centre by that much along x."""
        socket = self.world.car.T_base_socket
        target = socket[:3, 3] - socket[:3, 2] * gap_mm
        joints = gamma.inverse(GEOMETRY, TipPosition(*target))
        await self.move(joints._replace(rho3_mm=GEOMETRY.rho3.min_mm))
        for _ in range(4):
            await self.move(joints)
            plug = self.world.truth(self.now_s).T_base_plug
            axis, normal = plug[:3, 2], socket[:3, 2]
            to_face = socket[:3, 3] - plug[:3, 3]
            target += to_face - axis * float(to_face @ normal) / float(axis @ normal)
            target += off_mm * socket[:3, 0]
            joints = gamma.inverse(GEOMETRY, TipPosition(*target))
        plug = self.world.truth(self.now_s).T_base_plug
        assert abs(lateral_at_face_mm(plug, socket) - abs(off_mm)) < 0.1
        return joints

    async def insert(self, joints: JointPosition, depth_mm: float = 40.0) -> RobotState:
        """Push the plug in from where ``align`` left it."""
        missing_mm = depth_mm - self.world.truth(self.now_s).insertion_depth_mm
        return await self.move(joints._replace(rho3_mm=joints.rho3_mm + missing_mm))


def run(coroutine: Awaitable[T]) -> T:
    """Run to the end in virtual time."""

    async def main() -> T:
        return await coroutine

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(main())


def on_stand(
    scenario: Callable[[Stand], Awaitable[T]],
    parameters: SimulationParameters = PERFECT,
    seed: int = 1,
) -> T:
    """Run a scenario with an enabled robot, in virtual time."""

    async def main() -> T:
        garage = build_garage(
            GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), parameters, seed=seed
        )
        await garage.robot.connect()
        await garage.robot.enable()
        await garage.station.open()
        try:
            async with asyncio.timeout(LONGEST_SCENARIO_S):
                return await scenario(Stand(garage))
        finally:
            await garage.robot.close()

    return run(main())
