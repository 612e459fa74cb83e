"""The picture of a printed label."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.conditions import Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_condition import LabelCondition, drawn_condition
from drivers.simulator.camera.rain_drops import Drops, drops_on
from drivers.simulator.camera.soil import CELLS, SOIL_REFLECTANCE, soil
from drivers.simulator.camera.textured_plane import PlaneTexture
from twin.qr_label import QUIET_ZONE_MODULES, label_modules

_SHADOW_MM = 2.0
_SHADOW_DARKNESS = 0.35

Layer = NDArray[np.float32]


def label_reflectance(
    modules: NDArray[np.bool_], texels_per_module: int, black: float, white: float
) -> NDArray[np.float32]:
    """Picture of the whole label with its quiet zone; every texel lies in one module.

    Args:
        modules: True is black, shape (n, n).
        texels_per_module: Picture elements along one module.
        black: Reflectance of the ink, 0 to 1.
        white: Reflectance of the label's ground, 0 to 1.

    Returns:
        Reflectance, shape (m, m) with m = (n + 8) texels_per_module.
    """
    framed = np.pad(modules, QUIET_ZONE_MODULES)
    texels = np.where(framed, np.float32(black), np.float32(white))
    return texels.repeat(texels_per_module, axis=0).repeat(texels_per_module, axis=1)


class LabelPainter:
    """Paints one label, which the seed determines, as finely as is asked for.

    Args:
        imaging: Reflectances.
        conditions: What labels go through.
        seed: Determines what this one went through.
    """

    def __init__(self, imaging: ImagingParameters, conditions: Conditions, seed: int) -> None:
        self._imaging = imaging
        self._conditions = conditions
        self._seed = seed
        self.condition: LabelCondition = drawn_condition(conditions.label, self._generator(0))

    def texture(self, payload: str, label_size_mm: float, texels_per_module: int) -> PlaneTexture:
        """The label, with a faint shadow around it that keeps its middle in the origin.

        Raises:
            ValueError: the payload does not fit into a QR code.
        """
        modules = label_modules(payload)
        printed = label_reflectance(
            modules,
            texels_per_module,
            self._imaging.black_reflectance,
            self._imaging.white_reflectance,
        )
        texel_mm = label_size_mm / modules.shape[0] / texels_per_module
        worn = self._worn(printed, printed.shape[0] * texel_mm, modules.shape[0])
        alpha = np.ones_like(worn)
        if self.condition.lifted_mm or self.condition.bow_mm:
            worn, alpha = _with_shadow(worn, max(1, round(_SHADOW_MM / texel_mm)))
        return PlaneTexture(worn, alpha, texel_mm)

    def _worn(self, printed: Layer, side_mm: float, modules: int) -> Layer:
        numbers = self._conditions.label
        size = printed.shape[0]
        if numbers.grain_std:
            grain = self._generator(1).standard_normal((CELLS, CELLS), dtype=np.float32)
            grain = cv2.GaussianBlur(grain, (0, 0), 1.0) * np.float32(3.5 * numbers.grain_std)
            printed = printed * (1 + _resized(np.asarray(grain, np.float32), size))
        hidden = soil(numbers, modules / (modules + 2 * QUIET_ZONE_MODULES), self._generator(2))
        if hidden is not None:
            printed = printed + _resized(hidden, size) * (np.float32(SOIL_REFLECTANCE) - printed)
        drops = self._drops(side_mm)
        return printed if drops is None else drops.seen_through(printed)

    def _drops(self, side_mm: float) -> Drops | None:
        rain = self._conditions.rain
        return drops_on((side_mm, side_mm), rain, self._generator(3), cells_per_mm=CELLS / side_mm)

    def _generator(self, subject: int) -> np.random.Generator:
        return np.random.default_rng((self._seed, 0x1ABE1, subject))


class LabelKey(NamedTuple):
    """What decides how a label's texture looks."""

    payload: str
    label_size_mm: float
    texels_per_module: int


def _resized(layer: Layer, size: int) -> Layer:
    return np.asarray(cv2.resize(layer, (size, size), interpolation=cv2.INTER_LINEAR), np.float32)


def _with_shadow(reflectance: Layer, margin: int) -> tuple[Layer, Layer]:
    """Paper that stands off a little darkens its surroundings, more below than above."""
    paper = np.pad(np.ones_like(reflectance), margin)
    moved = np.roll(paper, margin // 3, axis=0)
    around = cv2.GaussianBlur(moved, (0, 0), margin / 3, borderType=cv2.BORDER_CONSTANT)
    alpha = np.maximum(paper, np.float32(_SHADOW_DARKNESS) * np.asarray(around, np.float32))
    return np.pad(reflectance, margin), alpha
