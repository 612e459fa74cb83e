"""A standing car's socket stays where it is: if it seems to move, the robot is not where it thinks.

This is the only way in which lost steps of the carriages show: they have no encoder. It works for
steps lost between the first and the last picture of a job. Steps lost before shift all pictures
alike, which does no harm, for the plug is led by the pictures; steps lost after the last picture
show only in the force, and only when the plug misses the socket's chamfer.
"""

from __future__ import annotations

import math

import numpy as np

from twin.divergence.findings import Quantity, Residual
from twin.divergence.numbers import SocketNumbers
from twin.divergence.samples import Sighting
from twin.geometry import RobotGeometry
from twin.kinematics import gamma


class SocketPlace:
    """Compares every sighting of a job with its first one, in the plane of the carriages.

    With the shift d, its direction e and the covariances of both pictures the standard deviation
    is sigma^2 = e^T (C1 + C2) e + (s + f * travel)^2: what calibration leaves over grows with the
    way of the platform between the two.

    Args:
        geometry: Of the robot.
        numbers: What calibration leaves over.
    """

    def __init__(self, geometry: RobotGeometry, numbers: SocketNumbers) -> None:
        self._geometry = geometry
        self._numbers = numbers
        self._first: Sighting | None = None

    def forget(self) -> None:
        """Another job, perhaps another car."""
        self._first = None

    def compare(self, sighting: Sighting) -> Residual | None:
        """The comparison with the first sighting; None for that one itself."""
        if self._first is None:
            self._first = sighting
            return None
        shift = (sighting.place_mm - self._first.place_mm)[:2]
        shift_mm = float(np.linalg.norm(shift))
        direction = shift / shift_mm if shift_mm > 0 else np.array([1.0, 0.0])
        covariance = (sighting.covariance_mm2 + self._first.covariance_mm2)[:2, :2]
        travel_mm = math.dist(
            gamma.platform(self._geometry, sighting.joints),
            gamma.platform(self._geometry, self._first.joints),
        )
        model_mm = self._numbers.model_sigma_mm + self._numbers.model_sigma_fraction * travel_mm
        variance = float(direction @ covariance @ direction)
        sigma_mm = math.sqrt(max(variance, 0.0) + model_mm**2)
        return Residual(Quantity.SOCKET, 0.0, shift_mm, sigma_mm, unit="mm")
