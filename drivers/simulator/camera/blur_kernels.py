"""Kernels of defocus and of motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_FINENESS = 8
_SHORTEST = 0.05  # a shorter way moves no light worth mentioning


def disc_kernel(diameter: float) -> NDArray[np.float32]:
    """An evenly lit disc of a diameter [texels], shape (n, n), n odd; its sum is 1."""
    half = int(np.ceil(diameter / 2 + 0.5))
    steps = (np.arange((2 * half + 1) * _FINENESS) + 0.5) / _FINENESS - half - 0.5
    inside = np.hypot(steps, steps[:, None]) <= diameter / 2
    side = 2 * half + 1
    shares = inside.reshape(side, _FINENESS, side, _FINENESS).mean(axis=(1, 3))
    return np.asarray(shares / shares.sum(), dtype=np.float32)


def line_kernel(way: NDArray[np.float64]) -> NDArray[np.float32] | None:
    """Average along a straight way [texels], centred, shape (n, n), n odd; None if too short."""
    length = float(np.hypot(*way))
    if length < _SHORTEST:
        return None
    half = int(np.ceil(np.abs(way).max() / 2)) + 1
    kernel = np.zeros((2 * half + 1, 2 * half + 1), dtype=np.float32)
    steps = max(int(np.ceil(8 * length)), 2)
    for share in (np.arange(steps) + 0.5) / steps - 0.5:
        x, y = way * share + half
        column, row = int(x), int(y)
        fx, fy = x - column, y - row
        kernel[row, column] += (1 - fx) * (1 - fy)
        kernel[row, column + 1] += fx * (1 - fy)
        kernel[row + 1, column] += (1 - fx) * fy
        kernel[row + 1, column + 1] += fx * fy
    kernel /= kernel.sum()
    return kernel
