"""Places of the platform: where it can stand to look, and where it would stand to plug in.

All are points of grids around the centre of the regular box, shape (n, 2) [mm].
"""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from server.control.built_robot import BuiltRobot
from twin.geometry import RobotGeometry
from twin.kinematics import alpha, singularity
from twin.workspace import Extent, reachable_region

Places = NDArray[np.float64]

BEYOND_MM = 20.0
"""So far beyond the regular box a car may stand, where the plug still gets there."""
RAIL_END_MM = 8.0
"""Room for coming to a place from below, and for a robot that is not built as drawn."""


def regular_places(geometry: RobotGeometry, step_mm: float) -> Places:
    """Where the platform must be able to plug in."""
    box = geometry.regular_box
    across, upward = 0.5 * box.width_mm, 0.5 * box.height_mm
    return _around(
        geometry,
        Extent(
            box.center_x_mm - across,
            box.center_x_mm + across,
            box.center_y_mm - upward,
            box.center_y_mm + upward,
        ),
        step_mm,
    )


def served_places(geometry: RobotGeometry, around_mm: Places, step_mm: float) -> Places:
    """Where the platform can plug in at all, and so far around it, shape (2,) [mm]."""
    region = reachable_region(geometry)
    # half a step more: what lies between the points of the grid belongs to the nearest one
    rings = np.ceil(around_mm / step_mm + 0.5).astype(int)
    low_x_mm, high_x_mm, low_y_mm, high_y_mm = region.extent
    more_x_mm, more_y_mm = (rings * step_mm).tolist()
    extent = Extent(
        low_x_mm - more_x_mm, high_x_mm + more_x_mm, low_y_mm - more_y_mm, high_y_mm + more_y_mm
    )
    places = _around(geometry, extent, step_mm)
    served = region.contains_many(places)
    served &= beyond_regular_box_mm(geometry, places) <= BEYOND_MM
    columns = len(np.unique(places[:, 0]))
    near = np.ones(2 * rings + 1, dtype=np.uint8)
    seeming = cv2.dilate(served.reshape(columns, -1).astype(np.uint8), near)
    return np.asarray(places[seeming.astype(bool).ravel()])


def standing_places(geometry: RobotGeometry, built: BuiltRobot, step_mm: float) -> Places:
    """Where the built platform can stand, with room at the ends of the rails."""
    places = _around(geometry, reachable_region(geometry).extent, step_mm)
    return places[can_stand(geometry, built, places)]


def can_stand(geometry: RobotGeometry, built: BuiltRobot, places: Places) -> NDArray[np.bool_]:
    """Whether the built platform can stand there, with room at the rails' ends, shape (n,)."""
    rho = alpha.inverse_many(geometry, places)
    stands = carriages_stand(geometry, rho)
    if built.correction is not None:
        stands &= _on_the_rails(
            geometry, built.correction.to_board_many(_drawn_back(geometry, rho))
        )
    return stands


def carriages_stand(geometry: RobotGeometry, rho_mm: Places) -> NDArray[np.bool_]:
    """Whether the drawn carriages have room at the rails' ends and the robot is stiff, shape (n,).

    Args:
        geometry: Of the robot.
        rho_mm: rho1 and rho2, shape (n, 2); NaN stands nowhere.
    """
    joints = _drawn_back(geometry, rho_mm)
    limits = singularity.thresholds(singularity.SingularityLimits())
    stiff = np.all(singularity.measures_many(geometry, joints) >= limits, axis=1)
    return np.asarray(stiff & _on_the_rails(geometry, joints))


def _drawn_back(geometry: RobotGeometry, rho_mm: Places) -> NDArray[np.float64]:
    """Joints with the slide drawn back, shape (n, 3)."""
    return np.column_stack((rho_mm, np.full(len(rho_mm), geometry.rho3.min_mm)))


def _on_the_rails(geometry: RobotGeometry, joints: NDArray[np.float64]) -> NDArray[np.bool_]:
    low = np.array([geometry.rho1.min_mm, geometry.rho2.min_mm]) + RAIL_END_MM
    high = np.array([geometry.rho1.max_mm, geometry.rho2.max_mm]) - RAIL_END_MM
    carriages = joints[:, :2]
    return np.asarray(np.all((carriages > low) & (carriages < high), axis=1))


def beyond_regular_box_mm(geometry: RobotGeometry, places: Places) -> NDArray[np.float64]:
    """How far outside the regular box places are, shape (n,)."""
    box = geometry.regular_box
    centre = np.array([box.center_x_mm, box.center_y_mm])
    half = 0.5 * np.array([box.width_mm, box.height_mm])
    return np.asarray(np.linalg.norm(np.maximum(np.abs(places - centre) - half, 0.0), axis=1))


def grid(xs: NDArray[np.generic], ys: NDArray[np.generic]) -> Places:
    """All pairs, x first, shape (len(xs) * len(ys), 2)."""
    return np.stack(np.meshgrid(xs, ys, indexing="ij"), axis=-1).reshape(-1, 2)


def _around(geometry: RobotGeometry, extent: Extent, step_mm: float) -> Places:
    box = geometry.regular_box
    xs = _multiples(extent.x_min_mm, extent.x_max_mm, box.center_x_mm, step_mm)
    ys = _multiples(extent.y_min_mm, extent.y_max_mm, box.center_y_mm, step_mm)
    return grid(xs, ys)


def _multiples(low: float, high: float, centre: float, step: float) -> NDArray[np.float64]:
    """Multiples of a step from the centre that hold everything from low to high."""
    first, last = math.floor((low - centre) / step), math.ceil((high - centre) / step)
    return np.asarray(centre + step * np.arange(first, last + 1), dtype=np.float64)
