"""Looks closely at the camera's pictures for as long as somebody watches."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraDriver, CameraModel, Frame
from server.jpeg import as_jpeg
from server.schema.inspection import CameraInspection
from server.schema.problem import problem_from
from server.schema.vehicles import Vehicle
from server.technician.seen_label import Look, look_at
from server.timing import Calendar
from server.vision import Locator

WIDTH_PX, QUALITY = 1024, 80
KEPT = 4
"""Pictures kept for those who have just read that there is one."""

NO_LIGHT, CLIPPED = 4, 251
RATE_FRAMES = 12
"""The rate of the sensor is that over so many looks."""

Image = NDArray[np.uint8]


class InspectionEndedError(Exception):
    """PlugPilot is ending: there will be no newer picture."""


@dataclass(frozen=True, slots=True)
class _Newest:
    shown: CameraInspection | None = None
    error: Exception | None = None


class CameraInspector:
    """Takes a picture, finds the label in it, takes the next one; rests when nobody asks.

    Args:
        camera: The camera.
        optics: Its calibrated model.
        vehicles: Gives the known vehicles, whose labels have a known size.
        calendar: Dates.
        period_s: Event loop time between two pictures at least.
        patience_s: Event loop time without a question after which it rests.
    """

    def __init__(
        self,
        camera: CameraDriver,
        optics: CameraModel,
        vehicles: Callable[[], Awaitable[Sequence[Vehicle]]],
        calendar: Calendar,
        *,
        period_s: float,
        patience_s: float,
    ) -> None:
        self._camera = camera
        self._vehicles = vehicles
        self._calendar = calendar
        self._period_s = period_s
        self._patience_s = patience_s
        self._locator = Locator(optics)
        self._newest = _Newest()
        self._sequence = 0
        self._pictures: dict[int, bytes] = {}
        self._frames: deque[Frame] = deque(maxlen=RATE_FRAMES)
        self._news = asyncio.Condition()
        self._wanted_until_s = 0.0
        self._task: asyncio.Task[None] | None = None
        self._closed = False

    @property
    def resting(self) -> bool:
        """Nobody looks, so no picture is taken."""
        return self._task is None or self._task.done()

    async def other_than(self, sequence: int) -> CameraInspection:
        """The newest picture unless it has this number; then the next one.

        Raises:
            CameraError: the camera does not deliver.
            InspectionEndedError: the inspector was closed.
        """
        while True:
            self._want()
            shown = self._newest.shown
            if shown is not None and shown.sequence != sequence:
                return shown
            async with self._news:
                await self._news.wait()
            if self._newest.error is not None:
                raise self._newest.error

    def picture(self, sequence: int) -> bytes | None:
        """The JPEG of a number; None if it was forgotten or never was."""
        return self._pictures.get(sequence)

    async def close(self) -> None:
        """End the work and whoever waits for it."""
        self._closed = True
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait([self._task])
        async with self._news:
            self._news.notify_all()

    def _want(self) -> None:
        if self._closed:
            raise InspectionEndedError
        self._wanted_until_s = asyncio.get_running_loop().time() + self._patience_s
        if self.resting:
            self._frames.clear()
            self._newest = _Newest()
            self._task = asyncio.create_task(self._run(), name="camera inspection")

    async def _run(self) -> None:
        loop = asyncio.get_running_loop()
        while loop.time() < self._wanted_until_s:
            due_s = loop.time() + self._period_s
            try:
                self._newest = _Newest(shown=await self._inspect())
            except Exception as error:  # noqa: BLE001 - handed to all who wait for the picture
                self._newest = _Newest(error=error)
            async with self._news:
                self._news.notify_all()
            if self._newest.error is not None:
                break
            await asyncio.sleep(due_s - loop.time())
        self._pictures.clear()

    async def _inspect(self) -> CameraInspection:
        loop = asyncio.get_running_loop()
        frame = await self._camera.frame()
        vehicles = await self._vehicles()
        look, jpeg = await asyncio.to_thread(self._work, frame.image, vehicles)
        self._frames.append(frame)
        self._sequence += 1
        self._keep(jpeg)
        label, refusal = look
        height, width = frame.image.shape
        return CameraInspection(
            sequence=self._sequence,
            taken_at=self._calendar.at(frame.captured_at_s),
            width_px=width,
            height_px=height,
            age_s=round(max(loop.time() - frame.captured_at_s, 0.0), 4),
            frames_per_s=self._rate(),
            exposure_ms=round(1000 * frame.exposure_s, 3) if frame.exposure_s > 0 else None,
            brightness=round(float(frame.image.mean()), 1),
            dark_share=round(float((frame.image <= NO_LIGHT).mean()), 4),
            bright_share=round(float((frame.image >= CLIPPED).mean()), 4),
            label=label,
            trouble=problem_from(refusal) if refusal is not None else None,
        )

    def _work(self, image: Image, vehicles: Sequence[Vehicle]) -> tuple[Look, bytes]:
        return look_at(self._locator, image, vehicles), as_jpeg(
            image, quality=QUALITY, most_width_px=WIDTH_PX
        )

    def _keep(self, jpeg: bytes) -> None:
        self._pictures[self._sequence] = jpeg
        self._pictures.pop(self._sequence - KEPT, None)

    def _rate(self) -> float | None:
        """Frames that the sensor made per second, those that nobody asked for too."""
        first, last = self._frames[0], self._frames[-1]
        span_s = last.captured_at_s - first.captured_at_s
        if span_s <= 0:
            return None
        return round((last.sequence - first.sequence) / span_s, 2)
