"""How far the belts have drifted, and whether that is more than was proven."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from server.calibration.drift.belts import BeltMemory
from server.calibration.routines.check_routine import nine_places
from server.schema.drift import BeltDrift, MaintenanceHint
from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

PROVEN_MM = 0.12
"""What a calibration is good for at least, and what it must say of itself to be worth less."""
SURELY = 3.0
MISFITS = 3
"""Jobs in a row whose looks do not fit: one alone may be a car that rocked."""


def moved_mm(geometry: RobotGeometry, one: PlanarAsBuilt, other: PlanarAsBuilt) -> float:
    """How far apart two robots stand at most that are sent to the same nine places.

    A shift of all places does not count: every job measures the label anew.
    """
    rho = one.inverse_many(np.stack(nine_places(geometry)))
    off = other.forward_many(rho) - one.forward_many(rho)
    return float(np.linalg.norm(off - off.mean(axis=0), axis=1).max())


def proven_mm(error_mm: float | None) -> float:
    """Within that a calibration is proven, by what it missed on looks that were held back."""
    return max(PROVEN_MM, SURELY * error_mm) if error_mm is not None else PROVEN_MM


def drift_of(
    memory: BeltMemory, geometry: RobotGeometry, measured: PlanarAsBuilt, error_mm: float | None
) -> BeltDrift:
    """The drift since the robot was measured."""
    shift_mm, within_mm = (
        moved_mm(geometry, measured, memory.corrected(measured)),
        proven_mm(error_mm),
    )
    (left, right), (left_sigma, right_sigma) = memory.belts.tolist(), memory.belts_sigma.tolist()
    return BeltDrift(
        jobs=memory.jobs,
        left_percent=100 * left,
        left_sigma_percent=100 * left_sigma,
        right_percent=100 * right,
        right_sigma_percent=100 * right_sigma,
        moved_mm=shift_mm,
        proven_mm=within_mm,
        exceeds=shift_mm > within_mm,
        at_bound=memory.at_bound,
        refused_in_a_row=memory.refused_in_a_row,
    )


def belt_hints(drift: BeltDrift) -> list[MaintenanceHint]:
    """What a person should know of it."""
    hints = []
    if drift.exceeds:
        stretch = max(drift.left_percent, drift.right_percent, key=abs)
        side = "left" if stretch == drift.left_percent else "right"
        hints.append(
            MaintenanceHint(
                code="belts_drifted",
                title="The robot has drifted further than was proven",
                text=f"Since it was measured, places have moved by up to {drift.moved_mm:.2f} mm; "
                f"{drift.proven_mm:.2f} mm were proven. The {side} belt goes {stretch:+.2f} % "
                "against then. Look at its tension, then measure the robot.",
                vehicle_id=None,
            )
        )
    if drift.refused_in_a_row >= MISFITS:
        hints.append(
            MaintenanceHint(
                code="looks_misfit",
                title="What jobs see does not go with the calibration",
                text=f"In {drift.refused_in_a_row} jobs in a row the label seemed to move. Nothing "
                "was learnt from that. Look whether belts, switches and camera sit tight, then "
                "measure the robot.",
                vehicle_id=None,
            )
        )
    return hints
