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
from drivers.camera.stream_clock import StreamClock

OPEN_TIMEOUT_MS, READ_TIMEOUT_MS = 5000, 2000

_WAITED_PERIODS = 0.25
"""A picture that takes so long to come was not in a queue."""

_LONGEST_QUEUE_S = 10.0
"""More than FFmpeg collects while it finds out what the stream holds."""


class StreamSource:
    """Implements FrameSource. The age of a stream's promptest pictures is assumed.

    With RTSP the pictures' time stamps tell how much older others are. Motion JPEG has none: there
    a picture counts as taken ``latency_s`` before it was read.

    Args:
        settings: Where it is, and how old its pictures are when they arrive.
    """

    def __init__(self, settings: StreamSettings) -> None:
        self._settings = settings
        self._capture: Any = None
        self._gaps = FrameGaps(settings.frames_per_s)
        self._clock = StreamClock(settings.latency_s)
        self._stamped = urlsplit(settings.url).scheme in {"rtsp", "rtsps"}

    @property
    def name(self) -> str:
        """Name a person recognises."""
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
        self._clock.restart()
        opened = capture.open(
            self._settings.address,
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

        self._pass_over_queue()

    def read(self) -> RawFrame:
        """Wait for the next picture.

        Raises:
            CameraMissingError: the stream has ended.
        """
        captured_s = self._grab()
        taken, picture = self._capture.retrieve()
        if not taken:
            raise CameraMissingError(f"The stream of {self.name} is damaged: check the network.")
        return RawFrame(
            grey(picture), captured_s, frames_since_last=self._gaps.frames_since_last(captured_s)
        )

    def skip(self) -> int:
        """Wait for the next picture.

        Raises:
            CameraMissingError: the stream has ended.
        """
        return self._gaps.frames_since_last(self._grab())

    def close(self) -> None:
        """Hang up."""
        capture, self._capture = self._capture, None
        if capture is not None:
            capture.release()

    def _grab(self) -> float:
        """Wait for the next picture; returns when it was taken [s]."""
        if not self._capture.grab():
            raise CameraMissingError(f"The stream of {self.name} has ended: check the network.")
        arrived_s = time.monotonic()
        if not self._stamped:
            return arrived_s - self._settings.latency_s
        stamped_s = float(self._capture.get(cv2.CAP_PROP_POS_MSEC)) / 1000
        return self._clock.captured_s(arrived_s, stamped_s)

    def _pass_over_queue(self) -> None:
        """Throw away what came in while the connection was made: nobody knows how old it is."""
        period_s = 1 / self._settings.frames_per_s
        for _ in range(round(_LONGEST_QUEUE_S / period_s)):
            asked_s = time.monotonic()
            self._grab()
            if time.monotonic() - asked_s >= _WAITED_PERIODS * period_s:
                return
