"""Pictures from a folder or a video in place of a camera."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera.errors import PicturesError
from drivers.camera.settings import ReplaySettings
from drivers.camera.source import RawFrame, grey

PICTURES = {".png", ".jpg", ".jpeg", ".bmp", ".webp", ".pgm"}


class ReplaySource:
    """Implements FrameSource. Pictures come at the set rate, in the order of their names.

    Args:
        settings: Which files, how fast.
    """

    def __init__(self, settings: ReplaySettings) -> None:
        self._settings = settings
        self._pictures: Iterator[NDArray[np.uint8]] | None = None
        self._due_s = 0.0
        self._closed = threading.Event()

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return f"Pictures of {self._settings.path.name}"

    def open(self) -> None:
        """Look for the pictures.

        Raises:
            PicturesError: there are none.
        """
        path = self._settings.path
        if not path.exists():
            raise PicturesError(f"There is no {path}: name a folder of pictures or a video.")
        if path.is_dir():
            files = sorted(file for file in path.iterdir() if file.suffix.lower() in PICTURES)
            if not files:
                raise PicturesError(
                    f"There is no picture in {path}: {', '.join(sorted(PICTURES))}."
                )
            self._pictures = _from_files(files, repeat=self._settings.repeat)
        else:
            self._pictures = _from_video(path, repeat=self._settings.repeat)
        self._closed.clear()
        self._due_s = time.monotonic()

    def read(self) -> RawFrame:
        """Wait until the next picture is due.

        Raises:
            PicturesError: they have come to their end, or one cannot be read.
        """
        if self._pictures is None:
            raise PicturesError(f"{self.name} is not open.")
        try:
            image = next(self._pictures)
        except StopIteration:
            raise PicturesError(f"{self.name} has come to its end.") from None
        self._closed.wait(max(0.0, self._due_s - time.monotonic()))
        self._due_s = max(self._due_s, time.monotonic()) + 1.0 / self._settings.frames_per_s
        return RawFrame(image, time.monotonic())

    def skip(self) -> int:
        """Wait until the next picture has gone by.

        Raises:
            PicturesError: as ``read``.
        """
        return self.read().frames_since_last

    def close(self) -> None:
        """Forget the place."""
        self._closed.set()
        self._pictures = None


def _from_files(files: list[Path], *, repeat: bool) -> Iterator[NDArray[np.uint8]]:
    while True:
        for file in files:
            picture = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
            if picture is None:
                raise PicturesError(f"{file.name} is empty or no picture: remove it.")
            yield np.asarray(picture, dtype=np.uint8)
        if not repeat:
            return


def _from_video(path: Path, *, repeat: bool) -> Iterator[NDArray[np.uint8]]:
    while True:
        video = cv2.VideoCapture(str(path))
        try:
            taken, picture = video.read()
            if not taken:
                raise PicturesError(f"{path.name} is empty or no video.")
            while taken:
                yield grey(np.asarray(picture, dtype=np.uint8))
                taken, picture = video.read()
        finally:
            video.release()
        if not repeat:
            return
