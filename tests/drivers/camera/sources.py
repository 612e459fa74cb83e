"""A source that a test leads by the hand."""

from __future__ import annotations

import queue
import time

import numpy as np

from drivers.camera.errors import CameraError
from drivers.camera.source import RawFrame

SHAPE = (48, 64)


class LedSource:
    """Delivers what the test hands it; ``read`` and ``skip`` wait for that."""

    name = "Test camera"

    def __init__(self) -> None:
        self.opened = 0
        self.closed = 0
        self.skipped = 0
        self.refuse: CameraError | None = None
        self._handed: queue.Queue[RawFrame | Exception] = queue.Queue()

    def hand(self, thing: RawFrame | Exception) -> None:
        self._handed.put(thing)

    def open(self) -> None:
        self.opened += 1
        if self.refuse is not None:
            raise self.refuse

    def read(self) -> RawFrame:
        thing = self._handed.get(timeout=10)
        if isinstance(thing, Exception):
            raise thing
        return thing

    def skip(self) -> int:
        frame = self.read()
        self.skipped += 1
        return frame.frames_since_last

    def close(self) -> None:
        self.closed += 1


def picture(value: int, *, age_s: float = 0.0, exposure_s: float = 0.0, lost: int = 0) -> RawFrame:
    image = np.full(SHAPE, value % 256, dtype=np.uint8)
    return RawFrame(image, time.monotonic() - age_s, exposure_s, 1 + lost)
