"""How blurred the edges of the board are."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.board_views import BoardView

SAMPLES = 33
REACH = 0.11
"""So far on both sides of an edge, as a share of a square, there is nothing but black and white:
the markers begin at 0.135."""
FEWEST_EDGES = 6
LEAST_STEP = 20.0
"""Grey values between black and white; with less there is no edge to speak of."""


class Sharpness(NamedTuple):
    """How the edges of the squares look.

    Attributes:
        blur_px: Standard deviation of their blur.
        square_px: Length of an edge, the median.
    """

    blur_px: float
    square_px: float


def sharpness_of(image: NDArray[np.uint8], view: BoardView, square_mm: float) -> Sharpness | None:
    """Blur of the board's edges; None: too few can be measured.

    Profiles across the middle of every edge between two corners, brought to one height and
    averaged, are the integral of the blur: its second moment is what the gradient's is. A profile
    shorter than the blur shows less of it, never more.

    Args:
        image: Grey values, shape (height, width).
        view: Where the corners are in it.
        square_mm: Side of a square.
    """
    first, second = _edges(view, square_mm)
    if len(first) < FEWEST_EDGES:
        return None
    along = view.image_px[second] - view.image_px[first]
    length = np.linalg.norm(along, axis=1)
    square_px = float(np.median(length))
    reach_px = REACH * square_px
    normal = np.column_stack((-along[:, 1], along[:, 0])) / length[:, None]
    middle = 0.5 * (view.image_px[first] + view.image_px[second])
    t_px = np.linspace(-reach_px, reach_px, SAMPLES)
    places = (middle[:, None] + normal[:, None] * t_px[:, None]).astype(np.float32)
    profiles = np.asarray(
        cv2.remap(image, places[..., 0], places[..., 1], cv2.INTER_LINEAR), np.float64
    )
    ends = profiles[:, :3].mean(axis=1), profiles[:, -3:].mean(axis=1)
    step = ends[1] - ends[0]
    clear = np.abs(step) > LEAST_STEP
    if np.count_nonzero(clear) < FEWEST_EDGES:
        return None
    rising = (profiles[clear] - ends[0][clear, None]) / step[clear, None]
    slope = np.clip(np.diff(np.median(rising, axis=0)), 0.0, None)
    between = 0.5 * (t_px[1:] + t_px[:-1])
    mean = float(slope @ between) / float(slope.sum())
    blur_px = float(np.sqrt(slope @ (between - mean) ** 2 / slope.sum()))
    return Sharpness(blur_px, square_px)


def _edges(view: BoardView, square_mm: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Numbers of corners that are one square apart."""
    squares = np.rint(view.board_mm / square_mm).astype(int)
    number_of = {(int(x), int(y)): number for number, (x, y) in enumerate(squares)}
    pairs = [
        (number, number_of[x + dx, y + dy])
        for (x, y), number in number_of.items()
        for dx, dy in ((1, 0), (0, 1))
        if (x + dx, y + dy) in number_of
    ]
    both = np.array(pairs, dtype=np.intp).reshape(-1, 2)
    return both[:, 0], both[:, 1]
