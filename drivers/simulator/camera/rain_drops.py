"""Drops of rain: on a surface, where they work as small lenses, and on the glass of the camera."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.coarse_grid import CoarseGrid
from drivers.simulator.camera.conditions import RainConditions
from drivers.simulator.camera.imaging import ImagingParameters

Layer = NDArray[np.float32]

_MAGNIFICATION = 1.25  # of what lies under a flat drop
_MM2_PER_DM2 = 1e4
_WIDEST = 3.0  # times the mean diameter


@dataclass(frozen=True, slots=True, eq=False)
class Drops:
    """Drops on a rectangle.

    Attributes:
        shift_x: Where a ray through a drop arrives, minus where it meets the drop, in shares of
            the width, shape (h, w).
        shift_y: The same in shares of the height.
        shine: Light that the drops add (rim below) or take (rim above), shape (h, w).
        inside: 1 in a drop, shape (h, w).
    """

    shift_x: Layer
    shift_y: Layer
    shine: Layer
    inside: Layer

    def seen_through(self, picture: Layer) -> Layer:
        """What a picture under the drops looks like, shape as before."""
        height, width = picture.shape
        x = cv2.resize(self.shift_x, (width, height)) * width + np.arange(width)
        y = cv2.resize(self.shift_y, (width, height)) * height + np.arange(height)[:, None]
        bent = cv2.remap(
            picture,
            np.asarray(x, np.float32),
            np.asarray(y, np.float32),
            cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        )
        shine = cv2.resize(self.shine, (width, height))
        return np.asarray(np.clip(bent + shine, 0.0, 1.5), dtype=np.float32)


def drops_on(
    size_mm: tuple[float, float],
    rain: RainConditions,
    rng: np.random.Generator,
    *,
    cells_per_mm: float,
) -> Drops | None:
    """Drops on a rectangle; None where there are none.

    Args:
        size_mm: Width and height.
        rain: How many and how large.
        rng: Decides where.
        cells_per_mm: Fineness of the maps.
    """
    width_mm, height_mm = size_mm
    count = int(rng.poisson(rain.drops_per_dm2 * width_mm * height_mm / _MM2_PER_DM2))
    if count == 0:
        return None
    columns, rows = round(width_mm * cells_per_mm), round(height_mm * cells_per_mm)
    shift_x, shift_y, shine, inside = (
        np.zeros((rows, columns), dtype=np.float32) for _ in range(4)
    )
    places = rng.uniform(size=(count, 2)) * (columns, rows)
    widths_mm = rain.drop_mm * np.clip(rng.lognormal(-0.1, 0.45, count), 0.3, _WIDEST)
    for (x, y), width in zip(places, widths_mm, strict=True):
        radius = max(width / 2 * cells_per_mm, 1.5)
        left, right = max(int(x - radius) - 1, 0), min(int(x + radius) + 3, columns)
        top, bottom = max(int(y - radius) - 1, 0), min(int(y + radius) + 3, rows)
        if left >= right or top >= bottom:
            continue
        across = (np.arange(left, right) - x) / radius
        down = ((np.arange(top, bottom) - y) / radius)[:, None]
        r = np.hypot(across, down)
        cover = np.clip((1 - r) * radius + 0.5, 0, 1).astype(np.float32)
        there = np.s_[top:bottom, left:right]
        keep = 1 - cover
        # the rim refracts most: what is seen there lies nearer to the drop's middle
        pull = (1 / _MAGNIFICATION - 1) * (1 + 0.6 * np.minimum(r, 1) ** 4)
        shift_x[there] = shift_x[there] * keep + cover * pull * across * radius / columns
        shift_y[there] = shift_y[there] * keep + cover * pull * down * radius / rows
        glint = 0.5 * np.exp(-(((across + 0.3) / 0.17) ** 2) - ((down + 0.42) / 0.13) ** 2)
        relief = 0.16 * down * np.minimum(r, 1) ** 2 - 0.10 * np.minimum(r, 1) ** 6
        shine[there] = shine[there] * keep + cover * (relief + glint)
        inside[there] = np.maximum(inside[there], cover)
    return Drops(shift_x, shift_y, shine, inside)


def lens_drop_cover(
    imaging: ImagingParameters,
    rain: RainConditions,
    grid: CoarseGrid,
    rng: np.random.Generator,
) -> Layer | None:
    """Share of the aperture that drops on the glass cover, as every node of the grid sees it.

    The light of one pixel passes the glass, at distance g, through a disc as wide as the aperture;
    so a drop is seen as its own disc blurred by that of the aperture, f / N across.

    Returns:
        Shares, shape (m, n); None without drops.
    """
    if not rain.lens_drops:
        return None
    cover = np.zeros(grid.rays.shape[:2], dtype=np.float64)
    reach = np.abs(grid.rays).reshape(-1, 2).max(axis=0) * rain.glass_mm
    places = rng.uniform(-1, 1, size=(rain.lens_drops, 2)) * reach
    radii_mm = rain.lens_drop_mm / 2 * np.clip(rng.lognormal(-0.1, 0.4, rain.lens_drops), 0.3, 3)
    aperture_mm = imaging.focal_length_mm / imaging.f_number / 2
    on_glass = grid.rays.astype(np.float64) * rain.glass_mm
    for place, radius_mm in zip(places, radii_mm, strict=True):
        distance = np.hypot(*np.moveaxis(on_glass - place, -1, 0))
        cover = np.maximum(cover, _common_share(distance, aperture_mm, float(radius_mm)))
    return cover.astype(np.float32)


def _common_share(
    distance: NDArray[np.float64], aperture: float, drop: float
) -> NDArray[np.float64]:
    """Area that two discs have in common, over the area of the aperture's."""
    d = np.maximum(distance, 1e-9)
    cos_a = np.clip((d**2 + aperture**2 - drop**2) / (2 * d * aperture), -1, 1)
    cos_b = np.clip((d**2 + drop**2 - aperture**2) / (2 * d * drop), -1, 1)
    triangle = (-d + aperture + drop) * (d + aperture - drop) * (d - aperture + drop)
    triangle = np.sqrt(np.maximum(triangle * (d + aperture + drop), 0.0))
    common = aperture**2 * np.arccos(cos_a) + drop**2 * np.arccos(cos_b) - 0.5 * triangle
    return np.asarray(common / (np.pi * aperture**2), dtype=np.float64)
