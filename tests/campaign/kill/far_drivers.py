"""The server's drivers: robot, camera and station at the other end of a wire."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator, Callable, Sequence
from typing import Any, cast

from drivers.camera import Frame
from drivers.registry import Devices
from drivers.robot import RobotIdentity, RobotState, StopCategory
from drivers.robot.telemetry_feed import TelemetryFeed
from drivers.station import StationCapabilities, StationSnapshot
from tests.campaign.kill.wire import TICK_S, Call, Tick, Tock, receive, send
from twin.motion.segments import Segment


class Wire:
    """Keeps the garage in step with this event loop, and carries calls to it.

    Args:
        path: Of the garage's socket.

    Attributes:
        feed: Samples of the motion board.
    """

    def __init__(self, path: str) -> None:
        self.feed = TelemetryFeed()
        self._line = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._line.connect(path)
        self._calls: list[Call] = []
        self._open: dict[int, asyncio.Future[Any]] = {}
        self._count = 0
        self._task: asyncio.Task[None] | None = None

    async def call(self, device: str, method: str, **arguments: object) -> Any:  # noqa: ANN401
        """Call a driver's method in the garage."""
        if self._task is None:
            self._task = asyncio.create_task(self._keep_step(), name="wire to the garage")
        self._count += 1
        self._calls.append(Call(self._count, device, method, arguments))
        future = self._open[self._count] = asyncio.get_running_loop().create_future()
        return await future

    async def _keep_step(self) -> None:
        loop = asyncio.get_running_loop()
        next_s = loop.time()
        while True:
            # Blocks on purpose: the clock of the loop stands still until the garage has come along.
            calls, self._calls = self._calls, []
            send(self._line, Tick(loop.time(), calls))
            self._take(receive(self._line))
            next_s += TICK_S
            await asyncio.sleep(next_s - loop.time())

    def _take(self, tock: Tock) -> None:
        for sample in tock.samples:
            self.feed.publish(sample)
        for answer in tock.answers:
            future = self._open.pop(answer.number)
            if future.done():
                continue
            if answer.error is None:
                future.set_result(answer.value)
            else:
                kind, arguments = answer.error
                future.set_exception(kind(*arguments))


class FarRobot:
    """A RobotDriver."""

    def __init__(self, wire: Wire) -> None:
        self._wire = wire

    async def connect(self) -> RobotIdentity:
        return cast("RobotIdentity", await self._wire.call("robot", "connect"))

    async def close(self) -> None:
        await self._wire.call("robot", "stop", category=StopCategory.DECELERATE_AND_RELEASE)

    def telemetry(self) -> AsyncIterator[RobotState]:
        return self._wire.feed.subscribe()

    async def enable(self) -> None:
        await self._wire.call("robot", "enable")

    async def disable(self) -> None:
        await self._wire.call("robot", "disable")

    async def home(self) -> None:
        await self._wire.call("robot", "home")

    async def set_force_limit(self, force_n: float) -> None:
        await self._wire.call("robot", "set_force_limit", force_n=force_n)

    async def push(self, segments: Sequence[Segment]) -> None:
        await self._wire.call("robot", "push", segments=list(segments))

    async def stop(self, category: StopCategory) -> None:
        await self._wire.call("robot", "stop", category=category)

    async def emergency_stop(self) -> None:
        await self._wire.call("robot", "emergency_stop")

    async def clear_fault(self) -> None:
        await self._wire.call("robot", "clear_fault")


class FarCamera:
    """A CameraDriver."""

    name = "Camera in the garage"

    def __init__(self, wire: Wire) -> None:
        self._wire = wire

    async def open(self) -> None:
        await self._wire.call("camera", "open")

    async def close(self) -> None:
        """It stays open in the garage."""

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        frame = await self._wire.call("camera", "frame", exposed_after_s=exposed_after_s)
        return cast("Frame", frame)


class FarStation:
    """A StationDriver."""

    name = "Station in the garage"
    capabilities = StationCapabilities(switches=True, holds=True, unlocks=True)

    def __init__(self, wire: Wire) -> None:
        self._wire = wire

    async def open(self) -> None:
        await self._wire.call("station", "open")

    async def close(self) -> None:
        """It goes on by itself."""

    async def snapshot(self) -> StationSnapshot:
        return cast("StationSnapshot", await self._wire.call("station", "snapshot"))

    async def start(self) -> None:
        await self._wire.call("station", "start")

    async def stop(self) -> None:
        await self._wire.call("station", "stop")

    async def hold(self) -> None:
        await self._wire.call("station", "hold")

    async def release(self) -> None:
        await self._wire.call("station", "release")

    async def unlock(self) -> None:
        await self._wire.call("station", "unlock")

    async def limit_current(self, current_a: float) -> None:
        await self._wire.call("station", "limit_current", current_a=current_a)

    def listen(self, listener: Callable[[], None]) -> None:
        """It only answers."""


def far_devices(path: str) -> Devices:
    """All drivers of the garage behind a socket."""
    wire = Wire(path)
    return Devices(FarRobot(wire), FarCamera(wire), FarStation(wire), garage=None)
