"""A camera driver on top of a blocking source: always the newest picture, never a stale queue."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from drivers.camera.errors import (
    CameraError,
    CameraFrozenError,
    CameraTimeoutError,
    WrongResolutionError,
)
from drivers.camera.model import CameraModel
from drivers.camera.protocol import Frame
from drivers.camera.source import FrameSource, RawFrame

_log = logging.getLogger(__name__)

TIMEOUT_S = 1.0
REOPEN_S = 1.0
"""Pause between two attempts to get a lost camera back."""

FROZEN_FRAMES = 10
"""So many pictures in a row without one different bit come from no living sensor."""

JOIN_S = 5.0


class GrabbingCamera:
    """Implements CameraDriver. A thread empties the source all the time, so no queue gets old.

    A camera that is lost is opened anew until ``close``; meanwhile ``frame`` says what is wrong.

    Args:
        source: Where pictures come from.
        optics: What the camera is calibrated for; pictures of another size are refused. None
            takes any size.
        moving: The source is a sensor, whose pictures differ by their noise at least.
    """

    def __init__(
        self, source: FrameSource, optics: CameraModel | None, *, moving: bool = True
    ) -> None:
        self._source = source
        self._optics = optics
        self._frozen_frames = FROZEN_FRAMES if moving else None
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        self._error: CameraError | None = CameraError(f"{source.name} is not open: open it first.")
        self._askers = 0
        self._newest: _Taken | None = None
        self._news = _News()
        self._sequence = -1
        self._dropped = 0
        self._same = _SameCounter()

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return self._source.name

    @property
    def dropped(self) -> int:
        """Pictures that the sensor made and that never came, since the start."""
        return self._dropped

    async def open(self) -> None:
        """Start to read; returns when the source is open.

        Raises:
            CameraError: it cannot be opened. It is tried again in the background.
        """
        if self._thread is not None:
            return
        loop = asyncio.get_running_loop()
        first: asyncio.Future[CameraError | None] = loop.create_future()
        self._closing = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(loop, self._closing, first), name="camera", daemon=True
        )
        self._thread.start()
        error = await first
        if error is not None:
            raise error

    async def close(self) -> None:
        """Release the camera. Safe to call twice."""
        thread, self._thread = self._thread, None
        if thread is None:
            return
        self._closing.set()
        self._fail(CameraError(f"{self.name} is not open: open it first."))
        await asyncio.to_thread(thread.join, JOIN_S)

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        """Wait for the next frame.

        Args:
            exposed_after_s: Only a frame whose exposure began at or after this event loop time
                will do; None takes the next one.

        Raises:
            CameraTimeoutError: none came within a second.
            CameraError: the camera is gone, frozen or delivers something else.
        """
        try:
            async with asyncio.timeout(TIMEOUT_S):
                return await self._next(exposed_after_s)
        except TimeoutError as error:
            raise CameraTimeoutError(
                f"{self.name} delivered no new picture within {TIMEOUT_S:g} s: check its cable."
            ) from error

    async def _next(self, exposed_after_s: float | None) -> Frame:
        asked_at = self._sequence
        self._askers += 1
        try:
            while True:
                if self._error is not None:
                    raise type(self._error)(str(self._error))
                newest = self._newest
                if newest is not None and newest.frame.sequence > asked_at:
                    if newest.wrong is not None:
                        raise newest.wrong
                    if exposed_after_s is None or newest.began_s >= exposed_after_s:
                        return newest.frame
                await self._news.wait()
        finally:
            self._askers -= 1

    # --- in the thread -----------------------------------------------------------------------

    def _run(
        self,
        loop: asyncio.AbstractEventLoop,
        closing: threading.Event,
        first: asyncio.Future[CameraError | None],
    ) -> None:
        tell_first: Callable[[CameraError | None], None] | None = partial(_settle, first)
        while not closing.is_set():
            failure: CameraError | None = None
            try:
                self._source.open()
                _call(loop, self._recover)
                if tell_first is not None:
                    _call(loop, partial(tell_first, None))
                    tell_first = None
                while not closing.is_set():
                    self._read_one(loop)
            except CameraError as error:
                failure = error
            except (OSError, RuntimeError, ValueError) as error:  # what camera libraries raise
                failure = CameraError(f"{self.name} has failed: {error}.")
            finally:
                self._source.close()
            if failure is not None and not closing.is_set():
                _log.warning("%s", failure)
                _call(loop, partial(self._fail, failure))
                if tell_first is not None:
                    _call(loop, partial(tell_first, failure))
                    tell_first = None
                closing.wait(REOPEN_S)

    def _read_one(self, loop: asyncio.AbstractEventLoop) -> None:
        """Pictures that nobody waits for are not even decoded."""
        if self._askers:
            _call(loop, partial(self._take, self._source.read()))
        else:
            _call(loop, partial(self._count, self._source.skip()))

    # --- in the event loop -------------------------------------------------------------------

    def _recover(self) -> None:
        self._error = None
        self._same.restart()

    def _fail(self, error: CameraError) -> None:
        self._error = error
        self._news.tell()

    def _take(self, raw: RawFrame) -> None:
        if self._thread is None:
            return
        self._count(raw.frames_since_last)
        # the thread's clock and the loop's need not be the same: only the age is carried over
        age_s = time.monotonic() - raw.captured_s
        captured_at_s = asyncio.get_running_loop().time() - age_s
        image = raw.image
        image.flags.writeable = False
        frame = Frame(image, captured_at_s, self._sequence, raw.exposure_s)
        self._newest = _Taken(frame, captured_at_s - 0.5 * raw.exposure_s, self._what_is_wrong(raw))
        self._news.tell()

    def _count(self, frames: int) -> None:
        self._sequence += frames
        self._dropped += frames - 1

    def _what_is_wrong(self, raw: RawFrame) -> CameraError | None:
        height, width = raw.image.shape
        optics = self._optics
        if optics is not None and (width, height) != (optics.width, optics.height):
            return WrongResolutionError(
                f"{self.name} delivers {width} x {height} pixels, but its calibration is for "
                f"{optics.width} x {optics.height}: choose that mode, or calibrate this one."
            )
        frozen = self._frozen_frames
        if frozen is not None and self._same.count(raw.image) >= frozen:
            return CameraFrozenError(
                f"{self.name} has delivered the very same picture {frozen} times: unplug it and "
                "plug it in again."
            )
        return None


@dataclass(frozen=True, slots=True)
class _Taken:
    frame: Frame
    began_s: float  # its exposure, event loop time
    wrong: CameraError | None


class _News:
    """Wakes all who wait now."""

    def __init__(self) -> None:
        self._waiting: set[asyncio.Future[None]] = set()

    async def wait(self) -> None:
        told = asyncio.get_running_loop().create_future()
        self._waiting.add(told)
        try:
            await told
        finally:
            self._waiting.discard(told)

    def tell(self) -> None:
        for told in self._waiting:
            if not told.done():
                told.set_result(None)


class _SameCounter:
    """How many times in a row the same picture came."""

    def __init__(self) -> None:
        self._last: NDArray[np.uint8] | None = None
        self._count = 1

    def count(self, image: NDArray[np.uint8]) -> int:
        same = self._last is not None and np.array_equal(self._last, image)
        self._count = self._count + 1 if same else 1
        self._last = image
        return self._count

    def restart(self) -> None:
        self._last = None
        self._count = 1


def _settle(first: asyncio.Future[CameraError | None], error: CameraError | None) -> None:
    if not first.done():
        first.set_result(error)


def _call(loop: asyncio.AbstractEventLoop, callback: Callable[[], None]) -> None:
    with contextlib.suppress(RuntimeError):  # the loop has ended before the camera
        loop.call_soon_threadsafe(callback)
