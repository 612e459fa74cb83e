"""Where to look from: the places that leave the least doubt at the plug's tip (V-optimal design).

With C the covariance that a set of looks leaves of everything that is solved for (prior included),
and S the way in which the robot's numbers move the tip all over the box (`tip_slopes`), the mean
squared doubt at the tip is

    tr(C M),    M = mean of S^T S,

and a further look with design A and noise R takes tr((A C A^T + R)^-1 A C M C A^T) of it away. The
set is found by adding the best place one after the other and then exchanging places for better
ones as long as that helps (Fedorov 1972).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.common_effects import (
    EFFECTS,
    common_effects,
    effect_sigmas,
    lines_of_sight,
)
from server.calibration.robot.errors import TooFewLooksError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import DISTANCE_SIGMA_MM
from server.calibration.robot.tip_doubt import tip_slopes
from server.calibration.robot.unknowns import MECHANISM, NAMES, Unknowns

Array = NDArray[np.float64]

LOOK_SIGMA_MM = 0.006
"""Of one look across the line of sight, as it is reckoned with before there is any."""

_ROUNDS = 8
_LEAST_GAIN = 1e-3
"""Of the doubt at the tip, as a share."""
_FAR_MM = 300.0
"""Standard deviation that stands for not knowing where the label is."""
_NOWHERE: Array = np.empty((0, 2))


def choose_places(
    candidates_rho_mm: Array,
    guess: Unknowns,
    known: KnownBefore,
    count: int,
    taken_rho_mm: Array = _NOWHERE,
) -> NDArray[np.int_]:
    """The best places among candidates, each at most once.

    Args:
        candidates_rho_mm: Carriages of each place from which the label is in the picture,
            shape (n, 2) [mm].
        guess: The robot as far as known.
        known: What is known beforehand.
        count: How many to choose.
        taken_rho_mm: Where the label was seen already, shape (k, 2) [mm].

    Returns:
        Their numbers, shape (count,), in the order in which they were chosen.

    Raises:
        TooFewLooksError: there are fewer candidates than that.
    """
    if len(candidates_rho_mm) < count:
        raise TooFewLooksError(
            f"The label is in the picture from {len(candidates_rho_mm)} places; "
            f"{count} are needed.",
            places=len(candidates_rho_mm),
        )
    places = _Places.of(candidates_rho_mm, guess)
    total = _prior_information(known)
    if len(taken_rho_mm):
        total = total + _Places.of(taken_rho_mm, guess).information().sum(axis=0)
    each, at_tip = places.information(), _at_tip(guess)
    chosen: list[int] = []
    for _ in range(count):
        best = _best(total, places, at_tip, chosen)
        chosen.append(best)
        total = total + each[best]
    for _ in range(_ROUNDS):
        before = _doubt(total, at_tip)
        for place in range(count):
            total = total - each[chosen[place]]
            others = chosen[:place] + chosen[place + 1 :]
            chosen[place] = _best(total, places, at_tip, others)
            total = total + each[chosen[place]]
        if before - _doubt(total, at_tip) < _LEAST_GAIN * before:
            break
    return np.array(chosen, dtype=int)


def in_travelling_order(rho_mm: Array, start_rho_mm: Array) -> NDArray[np.int_]:
    """An order that visits places with little travel: nearest first, then crossings undone (2-opt).

    Args:
        rho_mm: Carriages of the places, shape (n, 2) [mm].
        start_rho_mm: Where the robot stands, shape (2,) [mm].

    Returns:
        The order, shape (n,).
    """
    # the slower carriage decides how long a move takes
    way = np.abs(rho_mm[:, None] - rho_mm[None]).max(axis=2)
    from_start = np.abs(rho_mm - start_rho_mm).max(axis=1)
    order = [int(np.argmin(from_start))]
    left = set(range(len(rho_mm))) - set(order)
    while left:
        order.append(min(left, key=lambda place: (way[order[-1], place], place)))
        left.remove(order[-1])
    improved = True
    while improved:
        improved = False
        for first in range(len(order) - 1):
            for last in range(first + 1, len(order)):
                turned = order[:first] + order[first : last + 1][::-1] + order[last + 1 :]
                if _length(turned, way, from_start) < _length(order, way, from_start) - 1e-9:
                    order, improved = turned, True
    return np.array(order)


def _length(order: list[int], way: Array, from_start: Array) -> float:
    return float(from_start[order[0]] + way[order[:-1], order[1:]].sum())


@dataclass(frozen=True, slots=True, eq=False)
class _Places:
    """Looks that may be taken: their designs (n, 3, 30), and their noise (n, 3, 3)."""

    design: Array
    noise: Array

    @classmethod
    def of(cls, rho_mm: Array, guess: Unknowns) -> Self:
        label_mm, platform_mm = guess.predict(rho_mm), guess.built.forward_many(rho_mm)
        effects = common_effects(
            label_mm, platform_mm, guess.R_base_camera, guess.drawn.regular_box
        )
        sight = lines_of_sight(label_mm)
        noise = DISTANCE_SIGMA_MM**2 * np.einsum("ni,nj->nij", sight, sight)
        noise = noise + LOOK_SIGMA_MM**2 * np.eye(3)
        return cls(np.concatenate((guess.derivatives(rho_mm), effects), axis=2), noise)

    def information(self) -> Array:
        """Of a look from each place, shape (n, 30, 30)."""
        weighted = np.linalg.solve(self.noise, self.design)
        return np.asarray(np.swapaxes(self.design, 1, 2) @ weighted)


def _prior_information(known: KnownBefore) -> Array:
    sigma = np.concatenate((np.minimum(known.sigma, _FAR_MM), effect_sigmas(known.lens_sigma_rad)))
    return np.diag(1.0 / sigma**2)


def _at_tip(guess: Unknowns) -> Array:
    """M of the equation above, shape (30, 30)."""
    slopes = tip_slopes(guess)
    found = np.zeros((len(NAMES) + EFFECTS,) * 2)
    found[MECHANISM, MECHANISM] = np.einsum("nij,nik->jk", slopes, slopes) / len(slopes)
    return found


def _doubt(information: Array, at_tip: Array) -> float:
    return float(np.trace(np.linalg.solve(information, at_tip)))


def _best(total: Array, places: _Places, at_tip: Array, taken: list[int]) -> int:
    covariance = np.linalg.inv(total)
    seen = places.design @ covariance
    innovation = seen @ np.swapaxes(places.design, 1, 2) + places.noise
    taken_away = seen @ at_tip @ np.swapaxes(seen, 1, 2)
    gains = np.trace(np.linalg.solve(innovation, taken_away), axis1=1, axis2=2)
    gains[taken] = -np.inf
    return int(np.argmax(gains))
