"""Colours that stand for numbers, and the legend that says for which."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from viser import SceneApi

from twin.scene.frames import METRES_PER_MM, Vector, metres
from twin.scene.nodes import add_label

Anchors = tuple[tuple[int, int, int], ...]

GOOD_TO_BAD: Anchors = (
    (0, 140, 128),
    (126, 190, 90),
    (255, 205, 60),
    (240, 120, 40),
    (190, 30, 45),
)
EARLY_TO_LATE: Anchors = ((64, 120, 255), (40, 190, 220), (120, 220, 120), (255, 190, 50))
"""Both differ in lightness too, so that they are read without seeing red and green apart."""

_BAR_WIDTH = 18.0


@dataclass(frozen=True, slots=True)
class ColorScale:
    """Even steps from one number to another; numbers beyond its ends get the end's colour."""

    low: float
    high: float
    anchors: Anchors

    def rgb(self, values: ArrayLike) -> NDArray[np.uint8]:
        """Colours of numbers, shape (..., 3)."""
        span = self.high - self.low
        offsets = np.asarray(values, dtype=float) - self.low
        shares = np.clip(offsets / span if span > 0 else np.zeros_like(offsets), 0, 1)
        knots = np.linspace(0, 1, len(self.anchors))
        table = np.array(self.anchors, dtype=float)
        channels = [np.interp(shares, knots, table[:, i]) for i in range(3)]
        return np.round(np.stack(channels, axis=-1)).astype(np.uint8)


def add_legend(
    scene: SceneApi,
    name: str,
    scale: ColorScale,
    *,
    title: str,
    ends: tuple[str, str],
    foot_mm: Vector,
    height_mm: float,
) -> None:
    """A bar of the scale's colours that stands upright, with its two ends in words."""
    x, y, z = foot_mm
    values = np.linspace(scale.low, scale.high, 64)
    # Row 0 of a picture in the scene is its lowest.
    scene.add_image(
        f"{name}/bar",
        np.repeat(scale.rgb(values)[:, None], 4, axis=1),
        render_width=_BAR_WIDTH * METRES_PER_MM,
        render_height=height_mm * METRES_PER_MM,
        format="png",
        cast_shadow=False,
        receive_shadow=False,
        position=metres((x, y + height_mm / 2, z)),
    )
    low, high = ends
    add_label(scene, f"{name}/low", low, at_mm=(x, y - 8.0, z), anchor="top-center")
    add_label(scene, f"{name}/high", f"{title} {high}", at_mm=(x, y + height_mm + 8.0, z))
