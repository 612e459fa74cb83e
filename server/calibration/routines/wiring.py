"""Does each motor move its own carriage, the right way round?

Before anything is fitted, each carriage is moved a little by itself. What the platform does then
is compared with what it would do if the motors were connected in one of eight ways.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from server.calibration.routines.errors import AxesSwappedError, MotorReversedError, RoutineError
from twin.as_built import PlanarAsBuilt

Array = NDArray[np.float64]

CLEARLY_BETTER = 0.5
"""Another wiring is believed when it misses by less than this share of what the right one does."""

_SIDES = ("left", "right")


def check_wiring(
    built: PlanarAsBuilt, from_rho_mm: Array, steps_mm: Array, platform_mm: Array
) -> None:
    """Do nothing if the platform moved as it should.

    Args:
        built: The robot as far as known.
        from_rho_mm: Where the carriages stood, shape (2,) [mm].
        steps_mm: What they were told to do from there, one row each, shape (n, 2) [mm].
        platform_mm: What the camera saw the platform do, shape (n, 2) [mm].

    Raises:
        AxesSwappedError: the carriages answer for each other.
        MotorReversedError: one or both run the wrong way.
        RoutineError: the platform hardly moved at all.
    """
    told_mm = np.linalg.norm(_moved(built, from_rho_mm, steps_mm), axis=1)
    seen_mm = np.linalg.norm(platform_mm, axis=1)
    if np.any(seen_mm < CLEARLY_BETTER * told_mm):
        raise RoutineError(
            f"The platform was told to move by {told_mm[0]:.1f} and {told_mm[1]:.1f} mm, and moved "
            f"by {seen_mm[0]:.1f} and {seen_mm[1]:.1f} mm only."
        )
    missed = {
        (swapped, signs): float(
            np.linalg.norm(
                _moved(built, from_rho_mm, (steps_mm[:, ::-1] if swapped else steps_mm) * signs)
                - platform_mm
            )
        )
        for swapped, signs in product((False, True), product((1, -1), repeat=2))
    }
    swapped, signs = min(missed, key=lambda one: missed[one])
    if missed[swapped, signs] > CLEARLY_BETTER * missed[False, (1, 1)]:
        return
    if swapped:
        raise AxesSwappedError("When one carriage is told to move, the other one does.")
    reversed_sides = [side for side, sign in zip(_SIDES, signs, strict=True) if sign < 0]
    raise MotorReversedError(
        f"The {' and the '.join(reversed_sides)} carriage runs the wrong way.",
        carriages=reversed_sides,
    )


def _moved(built: PlanarAsBuilt, from_rho_mm: Array, steps_mm: Array) -> Array:
    return built.forward_many(from_rho_mm + steps_mm) - built.forward_many(from_rho_mm)
