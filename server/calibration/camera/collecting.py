"""Which pictures of a board in somebody's hands are kept, and what is wanted next."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.board_sight import BoardSight, Held
from server.calibration.camera.board_views import BoardView
from server.calibration.camera.coverage import COLUMNS, ROWS, coverage_map, covered_share
from server.schema.board import BoardAttitude, BoardNotice, BoardPlace, BoardWish

ENOUGH_VIEWS, MOST_VIEWS = 15, 40
ENOUGH_COVER = 0.85
"""Share of the cells; the plug may stand before some of them."""
OF_EACH = 2
"""So many views of every attitude."""
TRIES = 3
"""So many views from one part of the picture before another one is asked for first."""
TIPPED_RAD = math.radians(15.0)
TURNED_RAD = math.radians(60.0)
NEAR, FAR = 1.2, 1.55
"""Distances of the board, in its diagonals."""

STILL_SHARE_S = 0.012
"""Of the picture's width in a second: with a shutter of 30 ms the rows are then off by 0.5 px."""
BLURRED_PX, BLURRED_SHARE = 2.0, 0.045
"""With more blur, or more of it in a square's side, corners are found less exactly and markers are
lost. More than 0.06 of a side cannot be measured."""
NEW_PLACE, NEW_ANGLE_RAD, NEW_DISTANCE = 0.25, math.radians(9.0), 0.15
"""A view that differs by less than all of these from one that was kept tells nothing new."""

_PLACES: tuple[BoardPlace, ...] = (
    "upper_left", "top", "upper_right", "left", "middle", "right", "lower_left", "bottom",
    "lower_right",
)  # fmt: skip
_ATTITUDES: tuple[BoardAttitude, ...] = (
    "left_away", "top_away", "turned", "right_away", "bottom_away", "nearer", "farther",
)  # fmt: skip


@dataclass(slots=True, eq=False)
class BoardCollection:
    """Views of the board that were kept.

    Attributes:
        width_px: Of the picture.
        height_px: Of the picture.
        views: So far.
    """

    width_px: int
    height_px: int
    views: list[BoardView] = field(default_factory=list)
    _held: list[Held] = field(default_factory=list)
    _before: tuple[float, BoardView] | None = None

    @property
    def coverage(self) -> NDArray[np.int_]:
        """How many corners fell into each cell, shape (6, 8)."""
        if not self.views:
            return np.zeros((ROWS, COLUMNS), dtype=np.int_)
        return coverage_map(self.views, self.width_px, self.height_px)

    @property
    def complete(self) -> bool:
        """Nothing is missing, or there are more than enough."""
        if len(self.views) >= MOST_VIEWS:
            return True
        return (
            len(self.views) >= ENOUGH_VIEWS
            and covered_share(self.coverage) >= ENOUGH_COVER
            and self._rare_attitude() is None
        )

    @property
    def wanted(self) -> int:
        """How many views there should be, as far as can be told."""
        missing = sum(max(OF_EACH - self._count(each), 0) for each in _ATTITUDES)
        return min(max(ENOUGH_VIEWS, len(self.views) + missing), MOST_VIEWS)

    @property
    def wish(self) -> BoardWish:
        """What would tell most: the emptiest part of the picture, the rarest attitude."""
        if self.complete:
            return BoardWish(place=None, attitude=None)
        return BoardWish(place=self._empty_place(), attitude=self._rare_attitude())

    def take(self, sight: BoardSight, at_s: float) -> BoardNotice:
        """Keep what a picture shows if it is good and new.

        Args:
            sight: The picture.
            at_s: When it was taken.
        """
        view, held, before = sight.view, sight.held, self._before
        self._before = None if view is None else (at_s, view)
        if sight.strange:
            return "other_board"
        if view is None or held is None:
            return "show_more" if sight.markers else "no_board"
        if before is None or self._speed(before, at_s, view) > STILL_SHARE_S:
            return "moving"
        if _is_blurred(sight):
            return "blurred"
        if any(_alike(held, other) for other in self._held):
            return "known"
        self.views.append(view)
        self._held.append(held)
        return "taken"

    def _speed(self, before: tuple[float, BoardView], at_s: float, view: BoardView) -> float:
        """How fast the corners move through the picture, in its widths a second."""
        was_s, was = before
        here, there = _by_corner(view), _by_corner(was)
        moved = [float(np.linalg.norm(here[one] - there[one])) for one in here.keys() & there]
        if not moved or at_s <= was_s:
            return math.inf
        return float(np.median(moved)) / self.width_px / (at_s - was_s)

    def _empty_place(self) -> BoardPlace:
        """The part of the picture with most empty cells, then the one with fewest views.

        Where several views have not filled the cells, something stands before them: the plug.
        """
        parts = [
            float(np.mean(cells))
            for rows in np.array_split(self.coverage == 0, 3, axis=0)
            for cells in np.array_split(rows, 3, axis=1)
        ]
        views = [0] * len(_PLACES)
        for held in self._held:
            column, row = np.clip(np.floor(1.5 * (held.middle + 1)), 0, 2).astype(int).tolist()
            views[3 * row + column] += 1
        tried = [count >= TRIES for count in views]
        order = zip(tried, (-share for share in parts), views, _PLACES, strict=True)
        return min(order, key=lambda part: part[:3])[3]

    def _rare_attitude(self) -> BoardAttitude | None:
        counts = {each: self._count(each) for each in _ATTITUDES}
        rarest = min(_ATTITUDES, key=lambda each: counts[each])
        return rarest if counts[rarest] < OF_EACH else None

    def _count(self, attitude: BoardAttitude) -> int:
        return sum(_is_held(held, attitude, self._held[0]) for held in self._held)


def _is_blurred(sight: BoardSight) -> bool:
    seen = sight.sharpness
    return seen is None or seen.blur_px > min(BLURRED_PX, BLURRED_SHARE * seen.square_px)


def _by_corner(view: BoardView) -> dict[tuple[float, float], NDArray[np.float64]]:
    corners = [(x, y) for x, y in view.board_mm.tolist()]
    return dict(zip(corners, view.image_px, strict=True))


def _is_held(held: Held, attitude: BoardAttitude, first: Held) -> bool:
    match attitude:
        case "left_away":
            return held.left_away_rad > TIPPED_RAD
        case "right_away":
            return held.left_away_rad < -TIPPED_RAD
        case "top_away":
            return held.top_away_rad > TIPPED_RAD
        case "bottom_away":
            return held.top_away_rad < -TIPPED_RAD
        case "turned":
            return abs(math.remainder(held.turn_rad - first.turn_rad, math.pi)) > TURNED_RAD
        case "nearer":
            return held.distance < NEAR
        case "farther":
            return held.distance > FAR


def _alike(one: Held, other: Held) -> bool:
    return bool(
        np.abs(one.middle - other.middle).max() < NEW_PLACE
        and abs(one.left_away_rad - other.left_away_rad) < NEW_ANGLE_RAD
        and abs(one.top_away_rad - other.top_away_rad) < NEW_ANGLE_RAD
        and abs(math.remainder(one.turn_rad - other.turn_rad, 2 * math.pi)) < 2 * NEW_ANGLE_RAD
        and abs(math.log(one.distance / other.distance)) < NEW_DISTANCE
    )
