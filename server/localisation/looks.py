"""Where to look for a label that is not in the picture: as few looks as its footprint allows.

First everything where a car should stand is looked at, with the camera taken as it is known. Most
often that ends the search. Then follows every place from which the plug could serve a socket, with
all that the camera may be and the car may stand askew; near the regular box first. Looks are taken
greedily by what they newly show per second of travel.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from server.config.camera import NO_DOUBT
from server.config.insertion import InsertionSettings
from server.control.built_robot import BuiltRobot
from server.localisation.known_camera import KnownCamera
from server.localisation.picture_window import PictureWindow
from server.localisation.platform_places import (
    beyond_regular_box_mm,
    grid,
    regular_places,
    served_places,
    standing_places,
)
from server.schema.vehicles import Vehicle
from twin.geometry import RobotGeometry

PLACE_STEP_MM = 10.0
USUAL_STEP_MM, WIDE_STEP_MM = 10.0, 20.0
"""Between the places of the platform to choose from, in the first and in the second part."""
SECONDS_PER_LOOK = 0.4
TRAVEL_MM_S = 60.0
RARE_BEYOND_MM = 30.0
"""So far beyond the regular box cars stand e times more rarely."""

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Look:
    """A platform position to look from.

    Attributes:
        x_mm: Of V.
        y_mm: Of V.
        share: Of the labels that may be, which it newly shows.
        wide: It belongs to the second part of the search.
    """

    x_mm: float
    y_mm: float
    share: float
    wide: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class _Search:
    """One part of the search.

    Attributes:
        window: What a look shows.
        places: Where V would stand to plug in, shape (n, 2) [mm].
        weights: How likely each is, shape (n,); they add up to 1.
        step_mm: Between the places to look from.
    """

    window: PictureWindow
    places: Points
    weights: Points
    step_mm: float


class LookPlanner:
    """Plans looks for one robot and one vehicle.

    Args:
        geometry: Of the robot as drawn.
        built: Where it can stand as built.
        camera: As far as known.
        vehicle: Gives the label's size and its place beside the socket.
        insertion: The way of the slide before and behind the socket's face, and how askew a car
            may stand.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        built: BuiltRobot,
        camera: KnownCamera,
        vehicle: Vehicle,
        insertion: InsertionSettings,
    ) -> None:
        self._geometry = geometry
        self._built = built
        self._camera = camera
        self._vehicle = vehicle
        self._insertion = insertion

    def further_looks(self, x_mm: float, y_mm: float, rho3_mm: float) -> Iterator[Look]:
        """Looks in the order to take them, once one from where the platform stands showed nothing.

        Args:
            x_mm: Of the platform now.
            y_mm: Of the platform now.
            rho3_mm: Of the slide, which decides how much the plug hides.
        """
        taken = [np.array([x_mm, y_mm])]
        yield from self._looks(self._usual(rho3_mm), taken, wide=False)
        yield from self._looks(self._wide(rho3_mm), taken, wide=True)

    def _looks(self, search: _Search, taken: list[Points], *, wide: bool) -> list[Look]:
        """What this part of the search still needs; it is added to the places ``taken``."""
        candidates = standing_places(self._geometry, self._built, search.step_mm)
        if not len(candidates):
            return []
        shown_from = _shown_from_all(search, candidates)
        shown = np.any([search.window.shows(search.places - place) for place in taken], axis=0)
        left = np.where(shown, 0.0, search.weights)
        needed = _without_superfluous(
            _greedily(candidates, shown_from, left, taken[-1]), shown_from[:, ~shown]
        )
        candidates, shown_from = candidates[needed], shown_from[needed]
        looks = []
        for one in _greedily(candidates, shown_from, left, taken[-1]):
            x_mm, y_mm = candidates[one].tolist()
            looks.append(Look(x_mm, y_mm, float(shown_from[one] @ left), wide))
            left = np.where(shown_from[one], 0.0, left)
            taken.append(candidates[one])
        return looks

    def _usual(self, rho3_mm: float) -> _Search:
        """The regular box, by cars that stand straight and a camera that is as it is known."""
        middle_mm, half_mm = 0.5 * sum(self._faces_mm), 0.5 * self._geometry.regular_box.depth_mm
        places = regular_places(self._geometry, PLACE_STEP_MM)
        window = PictureWindow(
            self._geometry, replace(self._camera, doubt=NO_DOUBT), self._vehicle,
            faces_mm=(middle_mm - half_mm, middle_mm + half_mm),
            tilt_rad=0.0, cell_mm=PLACE_STEP_MM, rho3_mm=rho3_mm,
        )  # fmt: skip
        return _Search(window, places, np.full(len(places), 1.0 / len(places)), USUAL_STEP_MM)

    def _wide(self, rho3_mm: float) -> _Search:
        """Wherever the plug can serve a socket, and the label seems to be then."""
        window = PictureWindow(
            self._geometry, self._camera, self._vehicle,
            faces_mm=self._faces_mm, tilt_rad=math.radians(self._insertion.max_tilt_deg),
            cell_mm=PLACE_STEP_MM, rho3_mm=rho3_mm,
        )  # fmt: skip
        places = served_places(self._geometry, window.seeming_mm, PLACE_STEP_MM)
        beyond = beyond_regular_box_mm(self._geometry, places)
        weights = np.exp(-beyond / RARE_BEYOND_MM)
        return _Search(window, places, weights / weights.sum(), WIDE_STEP_MM)

    @property
    def _faces_mm(self) -> tuple[float, float]:
        """The slide reaches the face of a socket that it can serve between these two [mm]."""
        travel, insertion = self._geometry.rho3, self._insertion
        return (
            travel.min_mm + insertion.pre_insertion_distance_mm,
            travel.max_mm - insertion.depth_mm,
        )


def _shown_from_all(search: _Search, candidates: Points) -> NDArray[np.bool_]:
    """Which places looks show, shape (looks, places): equal ways need one answer."""
    steps = np.round((search.places[None] - candidates[:, None]) / PLACE_STEP_MM).astype(int)
    low, high = steps.min(axis=(0, 1)), steps.max(axis=(0, 1))
    ways = grid(*(np.arange(a, b + 1) for a, b in zip(low, high, strict=True)))
    shown = search.window.shows(PLACE_STEP_MM * ways).reshape(high - low + 1)
    return np.asarray(shown[tuple(np.moveaxis(steps - low, -1, 0))])


def _greedily(
    candidates: Points, shown_from: NDArray[np.bool_], weights: Points, here: Points
) -> list[int]:
    """Looks that show all that can be shown, by what they newly show per second.

    Args:
        candidates: Places of the platform, shape (looks, 2).
        shown_from: Which labels they show, shape (looks, labels).
        weights: How likely each label is; 0 for one that need not be shown, shape (labels,).
        here: Where the platform stands, shape (2,).
    """
    unseen, chosen = weights.copy(), []
    while (gains := shown_from @ unseen).any():
        travel_s = np.linalg.norm(candidates - here, axis=1) / TRAVEL_MM_S
        best = int(np.argmax(gains / (SECONDS_PER_LOOK + travel_s)))
        chosen.append(best)
        here = candidates[best]
        unseen[shown_from[best]] = 0.0
    return chosen


def _without_superfluous(chosen: list[int], shown_from: NDArray[np.bool_]) -> list[int]:
    """Looks without those all of whose places others show, too, the last ones left out first."""
    times = shown_from[chosen].sum(axis=0)
    needed = list(chosen)
    for one in reversed(chosen):
        if np.all(times[shown_from[one]] > 1):
            needed.remove(one)
            times = times - shown_from[one]
    return needed
