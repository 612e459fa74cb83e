"""What is on the label that does not belong there: specks, smears, something that covers it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.conditions import LabelConditions

CELLS = 384
"""Side of the maps, which cover the whole label with its quiet zone."""

SOIL_REFLECTANCE = 0.13

Layer = NDArray[np.float32]


def soil(numbers: LabelConditions, code_share: float, rng: np.random.Generator) -> Layer | None:
    """How much of what is printed the soil hides, 0 to 1, shape (CELLS, CELLS); None: nothing.

    Args:
        numbers: How dirty it is, and how much of the code is covered.
        code_share: Side of the code over the side of the label.
        rng: Decides where.
    """
    hidden = np.zeros((CELLS, CELLS), dtype=np.float32)
    if numbers.dirt:
        hidden = np.maximum(hidden, _dirt(numbers.dirt, rng))
    if numbers.covered:
        hidden = np.maximum(hidden, _cover(numbers.covered, code_share, rng))
    return hidden if hidden.any() else None


def _dirt(share: float, rng: np.random.Generator) -> Layer:
    """Half of the share in splashed specks, half in smears; soft edges, never quite opaque."""
    smear = cv2.GaussianBlur(_noise(rng), (0, 0), sigmaX=16, sigmaY=7)
    smear += 0.5 * smear.std() * cv2.GaussianBlur(_noise(rng), (0, 0), 2) / 0.14
    specks = np.zeros((CELLS, CELLS), dtype=np.uint8)
    wanted, tries = 0.5 * share * CELLS**2, 0
    while float(np.count_nonzero(specks)) < wanted and tries < 5000:
        tries += 1
        x, y = (int(value) for value in rng.integers(0, CELLS, 2))
        radius = int(np.clip(rng.lognormal(0.6, 0.6), 1, 14))
        cv2.ellipse(
            specks, (x, y), (radius, max(1, round(0.8 * radius))), float(rng.uniform(0, 180)),
            0, 360, (int(rng.integers(110, 235)),), cv2.FILLED,
        )  # fmt: skip
    speckled = cv2.GaussianBlur(np.asarray(specks, np.float32) / 255, (0, 0), 0.8)
    limit = float(np.quantile(smear, 1 - 0.5 * share))
    deepest = max(float(smear.max()) - limit, 1e-6)
    smeared = np.clip((smear - limit) / (0.5 * deepest), 0, 1) * 0.7
    return np.asarray(np.maximum(speckled, smeared), dtype=np.float32)


def _cover(share: float, code_share: float, rng: np.random.Generator) -> Layer:
    """Something with a ragged edge that comes in from one side and hides a share of the code."""
    angle = rng.uniform(0, 2 * np.pi)
    places = (np.arange(CELLS) + 0.5) / CELLS - 0.5
    across = places * np.cos(angle) + places[:, None] * np.sin(angle)
    across = across + 0.35 * cv2.GaussianBlur(_noise(rng), (0, 0), 9).astype(np.float64)
    margin = round(CELLS * (1 - code_share) / 2)
    code = across[margin : CELLS - margin, margin : CELLS - margin]
    limit = float(np.quantile(code, 1 - share))
    cover = cv2.GaussianBlur((across > limit).astype(np.float32), (0, 0), 0.8)
    return np.asarray(cover, dtype=np.float32)


def _noise(rng: np.random.Generator) -> Layer:
    return rng.standard_normal((CELLS, CELLS), dtype=np.float32)
