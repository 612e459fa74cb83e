"""The one protocol of cameras."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Frame:
    """One picture.

    Attributes:
        image: Grey values, shape (height, width), uint8, read-only.
        captured_at_s: Middle of the exposure, event loop time [s].
        sequence: Counts up by one for every frame the sensor made; gaps are dropped frames.
        exposure_s: How long it was exposed; 0 when nobody knows.
    """

    image: NDArray[np.uint8]
    captured_at_s: float
    sequence: int
    exposure_s: float = 0.0


class CameraDriver(Protocol):
    """A camera that always gives its newest picture, never one out of a stale queue."""

    @property
    def name(self) -> str:
        """Name a person recognises."""
        ...

    async def open(self) -> None:
        """Start the camera.

        Raises:
            CameraError: it cannot be opened; the message says what to do.
        """
        ...

    async def close(self) -> None:
        """Release the camera. Safe to call twice."""
        ...

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        """Wait for the newest frame.

        Args:
            exposed_after_s: Only a frame whose exposure began at or after this event loop time
                will do; None takes the next one.

        Raises:
            CameraTimeoutError: none came within a second.
            CameraError: the camera is gone.
        """
        ...
