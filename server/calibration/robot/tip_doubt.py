"""How far the plug's tip may still miss: what a calibration is for, and what its doubt means there.

Commanded to V, a robot whose numbers differ by d from the believed ones comes to V + J d. Where in
the room the base frame lies is a choice, so the rigid motion that suits all places of the box best
is taken off: with T the three small motions of the plane, P = 1 - T (T^T T)^-1 T^T and

    error = P J d,    d of the covariance that the fit has left.

To that comes what no look at a label tells: the inclination of the slide, which moves the tip up or
down with the depth, and the sag, which is not the same everywhere.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.common_effects import SAG_SIGMA_MM
from server.calibration.robot.solve import RobotSolution
from server.calibration.robot.unknowns import MECHANISM, Unknowns
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

SLIDE_SIGMA_RAD = np.radians(0.25)
"""Inclination of a slide that was put up by eye and a printed angle."""
_PLACES, _DEPTHS = 7, 3
_ROBOTS = 400
_SURE = 95.0


class TipDoubt(NamedTuple):
    """How far the tip misses in 95 % of the box [mm].

    Attributes:
        likely_mm: As likely more as less.
        at_most_mm: In 95 of 100 cases no more than that.
    """

    likely_mm: float
    at_most_mm: float


def tip_doubt(solution: RobotSolution) -> TipDoubt:
    """What the doubt about the built robot means at the tip, all over the regular box."""
    drawn = solution.unknowns.drawn
    slopes = tip_slopes(solution.unknowns)
    rng = np.random.default_rng(0)  # the same robots for everybody: no chance in the verdict
    covariance = solution.covariance[MECHANISM, MECHANISM]
    wrong = rng.multivariate_normal(np.zeros(len(covariance)), covariance, _ROBOTS)
    in_plane = np.einsum("nij,rj->rni", slopes, wrong)[:, None]
    depths_mm = np.linspace(-0.5, 0.5, _DEPTHS) * drawn.regular_box.depth_mm
    inclined = rng.normal(0.0, SLIDE_SIGMA_RAD, _ROBOTS)[:, None] * depths_mm
    sagged = rng.normal(0.0, SAG_SIGMA_MM, (_ROBOTS, 1, len(slopes)))
    up = in_plane[..., 1] + inclined[..., None] + sagged
    missed = np.hypot(in_plane[..., 0], up).reshape(_ROBOTS, -1)
    likely, at_most = np.percentile(np.percentile(missed, _SURE, axis=1), (50.0, _SURE)).tolist()
    return TipDoubt(likely, at_most)


def tip_slopes(unknowns: Unknowns) -> Array:
    """P J of the equation above at places all over the regular box, shape (n, 2, 7)."""
    platform = _platform_places(unknowns.drawn)
    return _without_rigid_motion(unknowns.tip_derivatives(platform), platform)


def _platform_places(drawn: RobotGeometry) -> Array:
    box = drawn.regular_box
    steps = np.linspace(-0.5, 0.5, _PLACES)
    x, y = np.meshgrid(
        box.center_x_mm + steps * box.width_mm, box.center_y_mm + steps * box.height_mm
    )
    return np.column_stack((x.ravel(), y.ravel()))


def _without_rigid_motion(slopes: Array, places: Array) -> Array:
    """P J, shape (n, 2, k)."""
    x, y = (places - places.mean(axis=0)).T
    motions = np.zeros((len(places), 2, 3))
    motions[:, 0, 0] = motions[:, 1, 1] = 1.0
    motions[:, 0, 2], motions[:, 1, 2] = -y, x
    basis, _ = np.linalg.qr(motions.reshape(-1, 3))
    flat = slopes.reshape(len(basis), -1)
    return np.asarray(flat - basis @ (basis.T @ flat)).reshape(slopes.shape)
