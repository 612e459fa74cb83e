"""Where pictures come from: blocking sources, read by a thread of their own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera.errors import CameraError


@dataclass(frozen=True, slots=True)
class RawFrame:
    """One picture as it came.

    Attributes:
        image: Grey values, shape (height, width), uint8.
        captured_s: Middle of the exposure on the monotonic clock of the machine [s].
        exposure_s: How long it was exposed; 0 when nobody knows.
        frames_since_last: 1, or more when the source knows that it has lost some.
    """

    image: NDArray[np.uint8]
    captured_s: float
    exposure_s: float = 0.0
    frames_since_last: int = 1


class FrameSource(Protocol):
    """A camera, a stream or a folder. All calls come from one thread, and may wait."""

    @property
    def name(self) -> str:
        """Name a person recognises."""
        ...

    def open(self) -> None:
        """Get hold of the camera.

        Raises:
            CameraError: that is not possible; the message says what to do.
        """
        ...

    def read(self) -> RawFrame:
        """Wait for the next picture.

        Raises:
            CameraError: there will be none; the source is to be closed and opened anew.
        """
        ...

    def skip(self) -> int:
        """Wait for the next picture and throw it away, with as little work as possible.

        Returns:
            1, or more when the source knows that it has lost some.

        Raises:
            CameraError: as ``read``.
        """
        ...

    def close(self) -> None:
        """Let go. Safe to call twice, and without having been opened."""
        ...


def grey(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Grey values of a picture of one or three (blue, green, red) channels.

    Raises:
        CameraError: it has another form.
    """
    if picture.dtype != np.uint8:
        raise CameraError(f"The camera delivers {picture.dtype} instead of bytes.")
    if picture.ndim == 2:
        return picture
    if picture.ndim == 3 and picture.shape[2] == 1:
        return picture[:, :, 0]
    if picture.ndim == 3 and picture.shape[2] == 3:
        return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), dtype=np.uint8)
    raise CameraError(f"The camera delivers pictures of the shape {picture.shape}.")
