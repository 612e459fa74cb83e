"""What the routine collects: where the label was seen while the carriages stood somewhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.common_effects import lines_of_sight

Array = NDArray[np.float64]

DISTANCE_SIGMA_MM = 0.02
"""What the laws of `common_effects` leave of a label's distance that is read off its size."""


@dataclass(frozen=True, slots=True, eq=False)
class LabelLook:
    """One look at the label, the robot at rest.

    Attributes:
        rho_mm: (rho1, rho2) as the board counts them, shape (2,) [mm].
        label_mm: Middle of the label in the camera frame, computed with the entered size,
            shape (3,) [mm].
        covariance_mm2: Of ``label_mm``, from the picture alone, shape (3, 3) [mm^2].
        turned_rad: How the label is turned in the picture.
    """

    rho_mm: Array
    label_mm: Array
    covariance_mm2: Array
    turned_rad: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class LookTable:
    """Many looks as arrays.

    Attributes:
        rho_mm: Shape (n, 2) [mm].
        label_mm: Shape (n, 3) [mm].
        covariance_mm2: What the picture says of itself, shape (n, 3, 3) [mm^2].
    """

    rho_mm: Array
    label_mm: Array
    covariance_mm2: Array

    @classmethod
    def of(cls, looks: Sequence[LabelLook]) -> LookTable:
        """Stack looks, one or more."""
        return cls(
            np.stack([look.rho_mm for look in looks]),
            np.stack([look.label_mm for look in looks]),
            np.stack([look.covariance_mm2 for look in looks]),
        )

    @property
    def across(self) -> Array:
        """Projections across the lines of sight, where looks are exact, shape (n, 3, 3)."""
        sight = lines_of_sight(self.label_mm)
        return np.asarray(np.eye(3) - np.einsum("ni,nj->nij", sight, sight))

    def whitening(self, rest_sigma_mm: float) -> Array:
        """W with W^T W the inverse covariance of a look, shape (n, 3, 3) [1/mm].

        Args:
            rest_sigma_mm: How exactly the platform comes to rest where it is sent, along each axis.
        """
        sight = lines_of_sight(self.label_mm)
        chance = rest_sigma_mm**2 * np.eye(3) + self.covariance_mm2
        chance = chance + DISTANCE_SIGMA_MM**2 * np.einsum("ni,nj->nij", sight, sight)
        return np.swapaxes(np.linalg.cholesky(np.linalg.inv(chance)), 1, 2)
