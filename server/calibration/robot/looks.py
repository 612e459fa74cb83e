"""What the routine collects: where the label was seen while the carriages stood somewhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
        whitening: W with W^T W the inverse covariance of a look, shape (n, 3, 3) [1/mm].
    """

    rho_mm: Array
    label_mm: Array
    whitening: Array

    @classmethod
    def of(cls, looks: Sequence[LabelLook], robot_sigma_mm: float) -> LookTable:
        """Stack looks.

        Args:
            looks: One or more.
            robot_sigma_mm: How exactly the platform comes to rest where it is sent (play,
                friction), along each axis; added to what the picture says of itself.
        """
        covariance = np.stack([look.covariance_mm2 for look in looks])
        covariance = covariance + robot_sigma_mm**2 * np.eye(3)
        lower = np.linalg.cholesky(np.linalg.inv(covariance))
        return cls(
            np.stack([look.rho_mm for look in looks]),
            np.stack([look.label_mm for look in looks]),
            np.swapaxes(lower, 1, 2),
        )
