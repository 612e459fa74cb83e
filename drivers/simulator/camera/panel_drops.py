"""Drops of rain on the car around the socket."""

from __future__ import annotations

import numpy as np

from drivers.simulator.camera.conditions import RainConditions
from drivers.simulator.camera.rain_drops import drops_on
from drivers.simulator.camera.textured_plane import PlaneTexture

_SIZE_MM = (480.0, 320.0)
_CELLS_PER_MM = 2.5
_DARK, _BRIGHT = 0.06, 0.75
_OPACITY = 0.55


def panel_drops(rain: RainConditions, seed: int) -> PlaneTexture | None:
    """Drops around the socket, with dark upper and bright lower rims; None without rain."""
    drops = drops_on(
        _SIZE_MM, rain, np.random.default_rng((seed, 0xD20B)), cells_per_mm=_CELLS_PER_MM
    )
    if drops is None:
        return None
    shade = np.clip(0.28 + 1.6 * drops.shine, _DARK, _BRIGHT)
    alpha = drops.inside * np.clip(_OPACITY * np.abs(drops.shine) / 0.1, 0.15, 0.9)
    return PlaneTexture(
        np.asarray(shade * alpha, np.float32), np.asarray(alpha, np.float32), 1 / _CELLS_PER_MM
    )
