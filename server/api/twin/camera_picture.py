"""A picture of the camera that is small enough to be laid into the 3D view."""

from __future__ import annotations

import asyncio

import cv2
import numpy as np

from server.jpeg import as_jpeg
from server.live.camera_feed import CameraFeed

WIDTH_PX = 320
QUALITY = 60


async def small_picture(feed: CameraFeed) -> bytes:
    """One new picture as JPEG, about 10 kB.

    Raises:
        CameraError: the camera does not deliver.
    """
    return await asyncio.to_thread(_shrunk, await feed.snapshot())


def _shrunk(jpeg: bytes) -> bytes:
    # A quarter of the size is what the decoder makes at no cost; the rest is scaled.
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_REDUCED_GRAYSCALE_4)
    if image is None:
        msg = "the camera feed delivered no JPEG"
        raise ValueError(msg)
    return as_jpeg(np.asarray(image, np.uint8), quality=QUALITY, most_width_px=WIDTH_PX)
