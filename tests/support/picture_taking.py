"""How light becomes grey values: the shot of a camera, with everything that spoils it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

Canvas = NDArray[np.float32]
Image = NDArray[np.uint8]

_NOISE_POOL = 1 << 21


@dataclass(frozen=True, slots=True)
class Shot:
    """One exposure. The defaults are those of a well lit garage.

    Attributes:
        blur_px: Standard deviation of lens and focus.
        motion_px: Way of the picture during the exposure along u and v.
        exposure: Linear output of a reflectance of 1; beyond 1 the sensor clips.
        gradient: Change of the light across the picture along u and v.
        vignetting: Loss of light in the corners.
        glare: Reflections of lamps: u and v [share of the picture], radius [share of the
            width], strength [linear output].
        full_well: Electrons at a linear output of 1 (photon noise).
        read_noise: Standard deviation of the linear output in the dark.
        gamma: Of the tone curve.
        sharpening: Share of the unsharp mask that the camera adds.
        jpeg: Quality of the compression; None leaves it out.
    """

    blur_px: float = 0.7
    motion_px: tuple[float, float] = (0.0, 0.0)
    exposure: float = 0.8
    gradient: tuple[float, float] = (0.15, -0.1)
    vignetting: float = 0.2
    glare: tuple[tuple[float, float, float, float], ...] = ()
    full_well: float = 5000.0
    read_noise: float = 0.0015
    gamma: float = 2.2
    sharpening: float = 0.0
    jpeg: int | None = None


def expose(canvas: Canvas, shot: Shot, rng: np.random.Generator) -> Image:
    """Grey values of a canvas of reflectances, shape (height, width); the canvas is spent."""
    height, width = canvas.shape
    x = np.linspace(-0.5, 0.5, width, dtype=np.float32)
    y = np.linspace(-0.5, 0.5, height, dtype=np.float32)[:, None]
    light = 1 + np.float32(shot.gradient[0]) * x + np.float32(shot.gradient[1]) * y
    light -= np.float32(2 * shot.vignetting) * (x * x + y * y)
    canvas *= light * np.float32(shot.exposure)
    for u, v, radius, strength in shot.glare:
        across = ((x + 0.5 - u) / radius) ** 2
        down = ((y + 0.5 - v) * (height / width) / radius) ** 2
        canvas += np.float32(strength) * np.exp(-across) * np.exp(-down)
    noise = _noise()
    start = int(rng.integers(_NOISE_POOL - canvas.size))
    deviation = np.sqrt(np.maximum(canvas, 0) / shot.full_well + np.float32(shot.read_noise**2))
    canvas += deviation * noise[start : start + canvas.size].reshape(canvas.shape)
    np.clip(canvas, 0, 1, out=canvas)
    grey = cv2.pow(canvas, 1 / shot.gamma)
    grey *= 255
    if shot.sharpening:
        soft = cv2.GaussianBlur(grey, (0, 0), 1.0)
        grey = grey + shot.sharpening * (grey - soft)
    image = np.clip(np.rint(grey), 0, 255).astype(np.uint8)
    if shot.jpeg is not None:
        encoded = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, shot.jpeg])[1]
        image = np.asarray(cv2.imdecode(encoded, cv2.IMREAD_GRAYSCALE), dtype=np.uint8)
    return image


@lru_cache(maxsize=1)
def _noise() -> NDArray[np.float32]:
    """Normal numbers to take pieces of: drawing a million for each picture costs too much."""
    return np.random.default_rng(1).standard_normal(_NOISE_POOL, dtype=np.float32)


def motion_kernel(way: NDArray[np.float64]) -> NDArray[np.float32] | None:
    """Average along a straight way [px], centred on its middle; None for no way at all."""
    length = float(np.hypot(*way))
    if length < 0.05:
        return None
    half = int(np.ceil(np.abs(way).max() / 2)) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1))
    count = int(np.ceil(16 * length))
    for share in (np.arange(count) + 0.5) / count - 0.5:
        u, v = way * share + half
        column, row = int(u), int(v)
        fu, fv = u - column, v - row
        weights = np.outer((1 - fv, fv), (1 - fu, fu))
        kernel[row : row + 2, column : column + 2] += weights
    return np.asarray(kernel / kernel.sum(), dtype=np.float32)
