"""Where to look from: the places that tell most about the mechanism (D-optimal design).

With F the information of a set of looks (prior included), split into the mechanism m and the rest
n (camera, label, size), the looks leave the mechanism with the information

    F_m|n = F_mm - F_mn F_nn^-1 F_nm,

and the set that makes its determinant largest leaves the smallest ellipsoid of doubt. It is found
by adding the best place one after the other and then exchanging places for better ones as long as
that helps (Fedorov 1972).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.errors import TooFewLooksError
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.unknowns import MECHANISM, NAMES, Unknowns

Array = NDArray[np.float64]

LOOK_SIGMA_MM = (0.02, 0.02, 0.06)
"""Of one look in the camera frame: across the picture, and in depth."""

_ROUNDS = 8
_LEAST_GAIN = 1e-3
_FAR_MM = 300.0
"""Standard deviation that stands for not knowing where the label is."""


def choose_places(
    candidates_rho_mm: Array, guess: Unknowns, known: KnownBefore, count: int
) -> NDArray[np.int_]:
    """The best places among candidates, each at most once.

    Args:
        candidates_rho_mm: Carriages of each place from which the label is in the picture,
            shape (n, 2) [mm].
        guess: The robot as far as known.
        known: What is known beforehand.
        count: How many to choose.

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
    each = _information_of_each(candidates_rho_mm, guess)
    total = _prior_information(known)
    chosen: list[int] = []
    for _ in range(count):
        best = _best(total, each, chosen)
        chosen.append(best)
        total = total + each[best]
    for _ in range(_ROUNDS):
        before = _log_det_mechanism(total[None])[0]
        for place in range(count):
            total = total - each[chosen[place]]
            others = chosen[:place] + chosen[place + 1 :]
            chosen[place] = _best(total, each, others)
            total = total + each[chosen[place]]
        if _log_det_mechanism(total[None])[0] - before < _LEAST_GAIN:
            break
    return np.array(chosen)


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


def _information_of_each(rho_mm: Array, guess: Unknowns) -> Array:
    """Information of a look from each place, shape (n, 14, 14)."""
    design = guess.derivatives(rho_mm) / np.array(LOOK_SIGMA_MM)[:, None]
    return np.asarray(np.einsum("nij,nik->njk", design, design))


def _prior_information(known: KnownBefore) -> Array:
    return np.diag(1.0 / np.minimum(known.sigma, _FAR_MM) ** 2)


def _best(total: Array, each: Array, taken: list[int]) -> int:
    gains = _log_det_mechanism(total + each)
    gains[taken] = -np.inf
    return int(np.argmax(gains))


def _log_det_mechanism(information: Array) -> Array:
    """Logarithm of det F_m|n, as log det F - log det F_nn, for many, shape (n,)."""
    rest = slice(MECHANISM.stop, len(NAMES))
    whole = np.linalg.slogdet(information)[1]
    return np.asarray(whole - np.linalg.slogdet(information[:, rest, rest])[1])
