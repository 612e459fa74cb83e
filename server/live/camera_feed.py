"""One stream of JPEG pictures for any number of viewers; the camera rests while nobody looks."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraDriver, CameraError
from server.jpeg import as_jpeg

STREAM_WIDTH_PX = 820
QUALITY = 75


class CameraFeed:
    """Encodes pictures and shares them.

    Args:
        camera: The camera.
        period_s: Event loop time between two pictures of the stream.
    """

    def __init__(self, camera: CameraDriver, period_s: float) -> None:
        self.online = True
        self._camera = camera
        self._period_s = period_s
        self._viewers = 0
        self._newest: bytes | None = None
        self._news = asyncio.Condition()
        self._task: asyncio.Task[None] | None = None
        self._error: Exception | None = None
        self._closed = False

    async def snapshot(self) -> bytes:
        """One new picture at full size, as JPEG.

        Raises:
            CameraError: the camera does not deliver.
        """
        return await asyncio.to_thread(_jpeg, await self._picture())

    async def stream(self) -> AsyncIterator[bytes]:
        """JPEG pictures for one viewer, newest only; ends when the feed is closed.

        Raises:
            CameraError: the camera does not deliver.
        """
        self._viewers += 1
        try:
            while not self._closed:
                if self._task is None or self._task.done():
                    self._task = asyncio.create_task(self._produce(), name="camera feed")
                async with self._news:
                    await self._news.wait()
                    picture, error = self._newest, self._error
                if error is not None:
                    raise error
                if picture is not None:
                    yield picture
        finally:
            self._viewers -= 1

    async def close(self) -> None:
        """End all streams."""
        self._closed = True
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait([self._task])
        self._newest = None
        async with self._news:
            self._news.notify_all()

    async def _produce(self) -> None:
        """One picture after the other for as long as somebody looks and the camera delivers."""
        self._newest = self._error = None
        loop = asyncio.get_running_loop()
        while self._viewers:
            due_s = loop.time() + self._period_s
            try:
                self._newest = await asyncio.to_thread(_small_jpeg, await self._picture())
            except Exception as error:  # noqa: BLE001 - handed to all who wait for the picture
                self._error = error
            async with self._news:
                self._news.notify_all()
            if self._error is not None:
                return
            await asyncio.sleep(due_s - loop.time())

    async def _picture(self) -> NDArray[np.uint8]:
        try:
            frame = await self._camera.frame()
        except CameraError:
            self.online = False
            raise
        self.online = True
        return frame.image


def _small_jpeg(image: NDArray[np.uint8]) -> bytes:
    return as_jpeg(image, quality=QUALITY, most_width_px=STREAM_WIDTH_PX)


def _jpeg(image: NDArray[np.uint8]) -> bytes:
    return as_jpeg(image, quality=QUALITY)
