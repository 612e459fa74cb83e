"""Network cameras: RTSP, or motion JPEG over HTTP, through OpenCV and FFmpeg."""

from __future__ import annotations

import time
from typing import Any
from urllib.parse import urlsplit

import cv2

from drivers.camera.errors import CameraMissingError
from drivers.camera.frame_timing import FrameGaps
from drivers.camera.settings import StreamSettings
from drivers.camera.source import RawFrame, grey

OPEN_TIMEOUT_MS, READ_TIMEOUT_MS = 5000, 2000


class StreamSource:
    """Implements FrameSource. A stream has no time stamps of its exposures: their age is assumed.

    Args:
        settings: Where it is, and how old its pictures are when they arrive.
    """

    def __init__(self, settings: StreamSettings) -> None:
        self._settings = settings
        self._capture: Any = None
        self._gaps = FrameGaps(settings.frames_per_s)

    @property
    def name(self) -> str:
        """Name a person recognises; without the password that may stand in the address."""
        parts = urlsplit(self._settings.url)
        return f"Camera at {parts.hostname or 'no address'}"

    def open(self) -> None:
        """Connect.

        Raises:
            CameraMissingError: nobody answers there, or not with pictures.
        """
        if not self._settings.url:
            raise CameraMissingError(
                "The network camera has no address: set camera.link.stream.url, for instance "
                "rtsp://camera.local/stream."
            )
        capture = cv2.VideoCapture()
        self._capture = capture
        self._gaps.restart()
        opened = capture.open(
            self._settings.url,
            cv2.CAP_FFMPEG,
            [
                cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, OPEN_TIMEOUT_MS,
                cv2.CAP_PROP_READ_TIMEOUT_MSEC, READ_TIMEOUT_MS,
            ],
        )  # fmt: skip
        if not opened:
            raise CameraMissingError(
                f"{self.name} does not answer with pictures: check the address and the network."
            )

    def read(self) -> RawFrame:
        """Wait for the next picture.

        Raises:
            CameraMissingError: the stream has ended.
        """
        taken, picture = self._capture.read()
        if not taken:
            raise CameraMissingError(f"The stream of {self.name} has ended: check the network.")
        captured_s = time.monotonic() - self._settings.latency_s
        return RawFrame(
            grey(picture), captured_s, frames_since_last=self._gaps.frames_since_last(captured_s)
        )

    def skip(self) -> int:
        """Wait for the next picture.

        Raises:
            CameraMissingError: the stream has ended.
        """
        if not self._capture.grab():
            raise CameraMissingError(f"The stream of {self.name} has ended: check the network.")
        return self._gaps.frames_since_last(time.monotonic() - self._settings.latency_s)

    def close(self) -> None:
        """Hang up."""
        capture, self._capture = self._capture, None
        if capture is not None:
            capture.release()
