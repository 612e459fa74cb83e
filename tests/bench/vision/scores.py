"""Errors of poses, their percentiles, and whether covariances keep their promise."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from server.vision.projection import Array, rotation_vector

CHI2_95_OF_SIX = 12.592
"""95th percentile of chi^2 with six degrees of freedom."""


@dataclass(slots=True)
class Scores:
    """What one method did on one set.

    Attributes:
        asked: Pictures it was given.
        errors: (omega [rad], tau [mm]) of every pose found.
        ranges_mm: True distance along the optical axis of every pose found.
        distances: Normalised squared errors, where the method gives a covariance.
        times_s: Processor time per picture.
    """

    asked: int = 0
    errors: list[Array] = field(default_factory=list)
    ranges_mm: list[float] = field(default_factory=list)
    distances: list[float] = field(default_factory=list)
    times_s: list[float] = field(default_factory=list)

    def add(
        self, found: Array | None, true: Array, time_s: float, covariance: Array | None = None
    ) -> None:
        """Take in one picture."""
        self.asked += 1
        self.times_s.append(time_s)
        if found is None:
            return
        turn = rotation_vector(found[:3, :3] @ true[:3, :3].T)
        error = np.concatenate((turn, found[:3, 3] - true[:3, 3]))
        self.errors.append(error)
        self.ranges_mm.append(float(true[2, 3]))
        if covariance is not None:
            self.distances.append(float(error @ np.linalg.solve(covariance, error)))

    @property
    def found_share(self) -> float:
        return len(self.errors) / self.asked if self.asked else 0.0

    @property
    def lateral_mm(self) -> Array:
        return np.array([np.hypot(error[3], error[4]) for error in self.errors])

    @property
    def depth_mm(self) -> Array:
        return np.array([abs(error[5]) for error in self.errors])

    @property
    def depth_bias_mm(self) -> tuple[float, float] | None:
        """Mean of the signed depth errors, and its standard error; None for fewer than two."""
        if len(self.errors) < 2:
            return None
        signed = np.array([error[5] for error in self.errors])
        return float(signed.mean()), float(signed.std(ddof=1) / np.sqrt(len(signed)))

    @property
    def tilt_deg(self) -> Array:
        return np.array([np.degrees(np.hypot(error[0], error[1])) for error in self.errors])

    @property
    def honest_share(self) -> float | None:
        """Share of true errors inside the stated 95% ellipsoid; None without covariances."""
        if not self.distances:
            return None
        return float(np.mean(np.array(self.distances) < CHI2_95_OF_SIX))

    @property
    def median_ms(self) -> float:
        return 1000 * float(np.median(self.times_s)) if self.times_s else 0.0


def merged(parts: list[Scores]) -> Scores:
    """Several sets as one."""
    return Scores(
        asked=sum(part.asked for part in parts),
        errors=[error for part in parts for error in part.errors],
        ranges_mm=[distance for part in parts for distance in part.ranges_mm],
        distances=[distance for part in parts for distance in part.distances],
        times_s=[time for part in parts for time in part.times_s],
    )
