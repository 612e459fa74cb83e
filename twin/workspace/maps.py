"""Maps over the wall plane: joints, stroke left, and every measure, on a grid of positions of V."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.kinematics.gamma import LIMIT_TOLERANCE_MM
from twin.workspace.boundary import Array
from twin.workspace.errors import InvalidGridError
from twin.workspace.measures import NO_FORCE, Measure, measure_rows
from twin.workspace.planar_force import PlanarForce
from twin.workspace.regions import reachable_region


@dataclass(frozen=True, slots=True)
class WorkspaceMaps:
    """A grid of positions of V; rows run along x, the first row is the lowest.

    Attributes:
        geometry: The robot.
        force: What the platform exerts in the maps of the forces.
        x_mm: Columns, shape (N,).
        y_mm: Rows, shape (M,).
        inside: Whether a position is reached, shape (M, N).
        rho1_mm: Joint position, shape (M, N), NaN where not reached.
        rho2_mm: Likewise.
        stroke_left_mm: Distance of the joints from the nearest end of their travel, likewise.
    """

    geometry: RobotGeometry
    force: PlanarForce
    x_mm: Array
    y_mm: Array
    inside: NDArray[np.bool_]
    rho1_mm: Array
    rho2_mm: Array
    stroke_left_mm: Array

    def of(self, measure: Measure) -> Array:
        """The map of a measure, shape (M, N), NaN where not reached."""
        rows = measure_rows(self.geometry, measure, self.y_mm, self.force)
        return np.where(self.inside, rows[:, np.newaxis], np.nan)


def workspace_maps(
    geometry: RobotGeometry, x_mm: Array, y_mm: Array, force: PlanarForce = NO_FORCE
) -> WorkspaceMaps:
    """Maps on the grid of all x (N,) and all y (M,)."""
    x_grid, y_grid = np.meshgrid(x_mm, y_mm)
    rho = alpha.inverse_many(geometry, np.stack((x_grid, y_grid), axis=-1))
    low = np.array([geometry.rho1.min_mm, geometry.rho2.min_mm])
    high = np.array([geometry.rho1.max_mm, geometry.rho2.max_mm])
    left = np.minimum(rho - low, high - rho).min(axis=-1)
    inside = left >= -LIMIT_TOLERANCE_MM
    rho[~inside] = np.nan
    return WorkspaceMaps(
        geometry=geometry,
        force=force,
        x_mm=x_mm,
        y_mm=y_mm,
        inside=inside,
        rho1_mm=rho[..., 0],
        rho2_mm=rho[..., 1],
        stroke_left_mm=np.where(inside, left, np.nan),
    )


def map_axes(geometry: RobotGeometry, step_mm: float) -> tuple[Array, Array]:
    """Evenly spaced x and y [mm] over the reachable region, both ends included.

    The spacing is the step or a little less.

    Raises:
        InvalidGridError: the step is not finite or not greater than zero.
        EmptyWorkspaceError: the robot reaches no position.
    """
    if not (math.isfinite(step_mm) and step_mm > 0):
        msg = f"a grid cannot have a step of {step_mm:g} mm"
        raise InvalidGridError(msg, {"step_mm": step_mm})
    extent = reachable_region(geometry).extent
    return (
        _even(extent.x_min_mm, extent.x_max_mm, step_mm),
        _even(extent.y_min_mm, extent.y_max_mm, step_mm),
    )


def _even(low_mm: float, high_mm: float, step_mm: float) -> Array:
    return np.linspace(low_mm, high_mm, 1 + max(1, math.ceil((high_mm - low_mm) / step_mm)))
