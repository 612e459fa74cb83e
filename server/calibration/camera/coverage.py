"""Which parts of the picture the board has been in."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.board_views import BoardView

COLUMNS, ROWS = 8, 6


def coverage_map(views: Sequence[BoardView], width_px: int, height_px: int) -> NDArray[np.int_]:
    """How many corners fell into each cell of a grid over the picture, shape (6, 8)."""
    points = np.concatenate([view.image_px for view in views])
    counts, _, _ = np.histogram2d(
        points[:, 1], points[:, 0], bins=(ROWS, COLUMNS),
        range=((-0.5, height_px - 0.5), (-0.5, width_px - 0.5)),
    )  # fmt: skip
    return np.asarray(counts, dtype=np.int_)


def covered_share(counts: NDArray[np.int_]) -> float:
    """Share of the cells that have seen a corner."""
    return float(np.mean(counts > 0))


def uncovered_edges(counts: NDArray[np.int_]) -> tuple[str, ...]:
    """Sides of the picture where no corner was ever near: the distortion there is a guess."""
    sides = {
        "left": counts[:, 0],
        "right": counts[:, -1],
        "top": counts[0],
        "bottom": counts[-1],
    }
    return tuple(name for name, cells in sides.items() if not np.any(cells))
