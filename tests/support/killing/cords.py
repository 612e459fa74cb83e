"""Drivers at cords that can be cut: from then on nothing gets through, in neither direction."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from typing import TypeVar

from drivers.camera import CameraDriver, CameraError, Frame
from drivers.robot import (
    NotConnectedError,
    RobotDriver,
    RobotIdentity,
    RobotState,
    StopCategory,
)
from drivers.station import StationCapabilities, StationDriver, StationError, StationSnapshot
from twin.motion.segments import Segment

T = TypeVar("T")


class Cord:
    """Between one life of a server and the world.

    Attributes:
        cut: The server has died. What it had sent before still arrives.
    """

    def __init__(self) -> None:
        self.cut = False


class CordedRobot:
    """A RobotDriver at a cord."""

    def __init__(self, robot: RobotDriver, cord: Cord) -> None:
        self._robot = robot
        self._cord = cord

    async def connect(self) -> RobotIdentity:
        return await self._do(self._robot.connect)

    async def close(self) -> None:
        if not self._cord.cut:
            await self._robot.close()

    async def telemetry(self) -> AsyncIterator[RobotState]:
        async for state in self._robot.telemetry():
            if self._cord.cut:
                return
            yield state

    async def enable(self) -> None:
        await self._do(self._robot.enable)

    async def disable(self) -> None:
        await self._do(self._robot.disable)

    async def home(self) -> None:
        await self._do(self._robot.home)

    async def set_force_limit(self, force_n: float) -> None:
        await self._do(lambda: self._robot.set_force_limit(force_n))

    async def push(self, segments: Sequence[Segment]) -> None:
        await self._do(lambda: self._robot.push(segments))

    async def stop(self, category: StopCategory) -> None:
        await self._do(lambda: self._robot.stop(category))

    async def emergency_stop(self) -> None:
        await self._do(self._robot.emergency_stop)

    async def clear_fault(self) -> None:
        await self._do(self._robot.clear_fault)

    async def _do(self, call: Callable[[], Awaitable[T]]) -> T:
        if self._cord.cut:
            raise NotConnectedError("This server is dead.")
        return await call()


class CordedStation:
    """A StationDriver at a cord."""

    def __init__(self, station: StationDriver, cord: Cord) -> None:
        self._station = station
        self._cord = cord

    @property
    def name(self) -> str:
        return self._station.name

    @property
    def capabilities(self) -> StationCapabilities:
        return self._station.capabilities

    async def open(self) -> None:
        await self._do(self._station.open)

    async def close(self) -> None:
        if not self._cord.cut:
            await self._station.close()

    async def snapshot(self) -> StationSnapshot:
        return await self._do(self._station.snapshot)

    async def start(self) -> None:
        await self._do(self._station.start)

    async def stop(self) -> None:
        await self._do(self._station.stop)

    async def hold(self) -> None:
        await self._do(self._station.hold)

    async def release(self) -> None:
        await self._do(self._station.release)

    async def unlock(self) -> None:
        await self._do(self._station.unlock)

    async def limit_current(self, current_a: float) -> None:
        await self._do(lambda: self._station.limit_current(current_a))

    def listen(self, listener: Callable[[], None]) -> None:
        self._station.listen(listener)

    async def _do(self, call: Callable[[], Awaitable[T]]) -> T:
        if self._cord.cut:
            raise StationError("This server is dead.")
        return await call()


class CordedCamera:
    """A CameraDriver at a cord."""

    def __init__(self, camera: CameraDriver, cord: Cord) -> None:
        self._camera = camera
        self._cord = cord

    @property
    def name(self) -> str:
        return self._camera.name

    async def open(self) -> None:
        await self._camera.open()

    async def close(self) -> None:
        if not self._cord.cut:
            await self._camera.close()

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        if self._cord.cut:
            raise CameraError("This server is dead.")
        return await self._camera.frame(exposed_after_s=exposed_after_s)
