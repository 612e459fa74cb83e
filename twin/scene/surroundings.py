"""The garage that metal and paint mirror: what stands around the scene, as one small picture.

Without it metal would be black. It is an equirectangular picture: columns run once around, rows
from straight up to straight down.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_SIZE = (128, 256)
"""Rows and columns: enough for soft lights, and a few thousand bytes."""
_CEILING, _WALLS, _FLOOR = 0.42, 0.26, 0.12
_WARM, _COOL = np.array((1.0, 0.97, 0.93)), np.array((0.93, 0.97, 1.0))
_EDGE_RAD = 0.07

# Soft lights: middle (azimuth, elevation), half sizes [rad], brightness, colour.
_LIGHTS = (
    ((-2.2, 0.75), (0.55, 0.28), 0.9, _WARM),
    ((-0.7, 0.95), (0.5, 0.22), 0.8, _WARM),
    ((0.9, 0.70), (0.6, 0.25), 0.75, _COOL),
    ((2.5, 0.85), (0.45, 0.25), 0.8, _COOL),
)


def surroundings() -> NDArray[np.uint8]:
    """A dim room with four soft lights under its ceiling, shape (128, 256, 3), BGR, sRGB."""
    rows, columns = _SIZE
    azimuth = (np.arange(columns) + 0.5) / columns * 2 * np.pi - np.pi
    elevation = np.pi / 2 - (np.arange(rows) + 0.5) / rows * np.pi
    up = np.sin(elevation)[:, None, None]
    ground = np.where(
        up > 0, _WALLS + (_CEILING - _WALLS) * up, _WALLS + (_WALLS - _FLOOR) * np.maximum(up, -1)
    )
    room = np.broadcast_to(ground, (rows, columns, 3)).copy()
    for (az, el), (half_az, half_el), brightness, color in _LIGHTS:
        across = _soft(np.abs(azimuth - az), half_az)[None, :]
        along = _soft(np.abs(elevation - el), half_el)[:, None]
        share = (across * along)[..., None]
        room = room * (1 - share) + share * (brightness + 0.1) * color
    linear = np.clip(room, 0, 1)
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    picture: NDArray[np.uint8] = np.round(255 * srgb[..., ::-1]).astype(np.uint8)
    return picture


def _soft(distance: NDArray[np.float64], half: float) -> NDArray[np.float64]:
    """1 inside, 0 outside, and a smooth edge between."""
    t = np.clip((half + _EDGE_RAD - distance) / (2 * _EDGE_RAD), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))
