"""What is printed on a label, and what happens to the print: dirt, covers, another label on top."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

FINE = 24
"""Texels along one module in the finest version of a print."""

QUIET_MODULES = 4


@dataclass(frozen=True, slots=True, eq=False)
class Print:
    """A square picture with a code in its middle.

    Attributes:
        reflectance: Shape (m, m), 0 to 1, with a whole number of texels in every module.
        modules: Modules along one side of the code.
        quiet: White modules on every side of it.
        size_mm: Outer side of the code as it really is.
    """

    reflectance: NDArray[np.float32]
    modules: int
    quiet: int
    size_mm: float

    @property
    def module_mm(self) -> float:
        return self.size_mm / self.modules

    @property
    def side_mm(self) -> float:
        """Side of the whole paper."""
        return self.module_mm * (self.modules + 2 * self.quiet)

    def with_texels(self, per_module: int) -> NDArray[np.float32]:
        """The print with so many texels along a module."""
        side = (self.modules + 2 * self.quiet) * per_module
        scaled = cv2.resize(self.reflectance, (side, side), interpolation=cv2.INTER_AREA)
        return np.asarray(scaled, dtype=np.float32)

    def changed(self, reflectance: NDArray[np.float32]) -> Print:
        return replace(self, reflectance=reflectance)


def printed(
    modules: NDArray[np.bool_],
    size_mm: float,
    *,
    ink_modules: float = 0.0,
    black: float = 0.06,
    white: float = 0.85,
) -> Print:
    """Print a module matrix (True is black).

    Args:
        modules: Shape (n, n).
        size_mm: Outer side of the code.
        ink_modules: How far the ink runs beyond every edge, in modules; negative for too little.
        black: Reflectance of the ink.
        white: Reflectance of the paper.
    """
    count = modules.shape[0]
    ink = _inked(np.packbits(modules).tobytes(), count, round(ink_modules * FINE))
    grey = np.where(ink, np.float32(black), np.float32(white))
    return Print(grey, count, QUIET_MODULES, size_mm)


@lru_cache(maxsize=32)
def _inked(packed: bytes, count: int, spread_texels: int) -> NDArray[np.bool_]:
    bits = np.unpackbits(np.frombuffer(packed, dtype=np.uint8), count=count * count)
    framed = np.pad(bits.reshape(count, count), QUIET_MODULES)
    fine = framed.repeat(FINE, axis=0).repeat(FINE, axis=1)
    if spread_texels:
        side = 2 * abs(spread_texels) + 1
        kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
        change = cv2.dilate if spread_texels > 0 else cv2.erode
        fine = np.asarray(change(fine, kernel), dtype=np.uint8)
    return fine.astype(np.bool_)


def mirrored(label: Print) -> Print:
    return label.changed(np.ascontiguousarray(label.reflectance[:, ::-1]))


def dirty(label: Print, rng: np.random.Generator, spots: int) -> Print:
    """Splashes of mud, grey and brown, of up to two modules across, and a wiped veil."""
    grey = label.reflectance.copy()
    side = len(grey)
    layer = np.zeros_like(grey)
    for _ in range(spots):
        centre = tuple(int(value) for value in rng.integers(0, side, 2))
        axes = tuple(int(value) for value in rng.uniform(0.2, 1.0, 2) * FINE)
        turn = float(rng.uniform(0, 180))
        cv2.ellipse(layer, centre, axes, turn, 0, 360, float(rng.uniform(0.5, 1.0)), -1)
    layer = np.asarray(cv2.GaussianBlur(layer, (0, 0), 0.15 * FINE), dtype=np.float32)
    mud = np.float32(rng.uniform(0.08, 0.35))
    veil = _clouds(rng, side) * np.float32(rng.uniform(0.0, 0.25))
    grey = grey * (1 - veil) + np.float32(0.4) * veil
    return label.changed(np.asarray(grey * (1 - layer) + mud * layer, dtype=np.float32))


def _clouds(rng: np.random.Generator, side: int) -> NDArray[np.float32]:
    small = rng.random((8, 8), dtype=np.float32)
    return np.asarray(cv2.resize(small, (side, side), interpolation=cv2.INTER_CUBIC).clip(0, 1))


def covered(label: Print, rng: np.random.Generator, share: float) -> Print:
    """Something plain sticks over a border of the code: a leaf, tape, a fold of the flap."""
    grey = label.reflectance.copy()
    side = len(grey)
    margin = label.quiet * FINE
    depth = margin + round(share * (side - 2 * margin))
    tone = np.float32(rng.uniform(0.05, 0.8))
    strip = np.zeros_like(grey)
    slant = rng.uniform(-0.1, 0.1) * side
    corners = np.array([(0, 0), (side, 0), (side, depth + slant), (0, depth - slant)])
    cv2.fillPoly(strip, [corners.round().astype(np.int32)], 1.0)
    strip = np.rot90(strip, int(rng.integers(4)))
    return label.changed(np.where(strip > 0, tone, grey))


def pasted_over(label: Print, other: Print, rng: np.random.Generator, share: float) -> Print:
    """Another label of the same kind stuck over a part, moved by some fraction of a module."""
    grey = label.reflectance.copy()
    side = len(grey)
    shift = rng.uniform(-1.5, 1.5, 2) * FINE
    matrix = np.array([[1.0, 0.0, shift[0]], [0.0, 1.0, shift[1]]])
    moved = cv2.warpAffine(other.reflectance, matrix, (side, side), borderMode=cv2.BORDER_REPLICATE)
    cut = round(side * (1 - share))
    covered_part = np.zeros((side, side), dtype=np.bool_)
    covered_part[cut:] = True
    covered_part = np.rot90(covered_part, int(rng.integers(4)))
    return label.changed(np.where(covered_part, np.asarray(moved, dtype=np.float32), grey))
