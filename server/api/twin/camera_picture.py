"""A picture of the camera that is small enough to be laid into the 3D view."""

from __future__ import annotations

import asyncio

import cv2
import numpy as np

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
    height, width = image.shape
    scale = min(1.0, WIDTH_PX / width)
    size = (round(width * scale), round(height * scale))
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    _, encoded = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    return encoded.tobytes()
