"""From where the label is in the picture, and not behind the robot's own plug."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.localisation.picture_window import LABEL_MARGIN
from server.localisation.platform_places import carriages_stand
from server.localisation.plug_shadow import hidden_by_plug
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.kinematics import alpha, gamma

Array = NDArray[np.float64]

STEP_MM = 20.0
REACH_MM = 220.0


class Margins(NamedTuple):
    """Room that a label must keep.

    Attributes:
        edge_px: From the picture's edge.
        plug_mm: From the plug: at least what the camera may sit beside its place on the drawing.
    """

    edge_px: float
    plug_mm: float


def reachable_places(geometry: RobotGeometry, centre_mm: Array) -> Array:
    """Carriages of a grid of places that the robot reaches and where it is stiff.

    Args:
        geometry: Of the robot as drawn.
        centre_mm: Of the grid, shape (2,) [mm].

    Returns:
        (rho1, rho2) of the drawing, shape (n, 2) [mm].
    """
    steps = np.arange(-REACH_MM, REACH_MM + 1, STEP_MM)
    away = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    rho = alpha.inverse_many(geometry, centre_mm + away)
    return rho[carriages_stand(geometry, rho)]


def label_is_seen(
    label_mm: Array,
    *,
    half_mm: float,
    optics: CameraModel,
    edge_px: float,
    hidden: Callable[[Array], NDArray[np.bool_]],
) -> NDArray[np.bool_]:
    """Whether the whole label is in the picture, shape (n,).

    Args:
        label_mm: Its middle in the camera frame, shape (n, 3) [mm].
        half_mm: From its middle to each side of the square about it, level with the picture.
        optics: Of the camera.
        edge_px: Room that it must keep from the picture's edge.
        hidden: Which points in the camera frame, shape (m, 3), the plug hides.
    """
    sides = np.array([-1.0, 0.0, 1.0])
    about = np.stack(np.meshgrid(sides, sides, [0.0]), axis=-1).reshape(-1, 3) * half_mm
    points = (label_mm[:, None] + about).reshape(-1, 3)
    pixels, _ = cv2.projectPoints(
        points, np.zeros(3), np.zeros(3), optics.matrix, optics.distortion
    )
    room = np.minimum(pixels, [optics.width - 1, optics.height - 1] - pixels).min(axis=(1, 2))
    seen = (room > edge_px) & (points[:, 2] > 0) & ~hidden(points)
    return np.asarray(seen.reshape(len(label_mm), -1).all(axis=1))


def half_of_label_mm(label_size_mm: float, turned_rad: float) -> float:
    """Half the side of the level square about a label and its quiet zone [mm]."""
    turned = abs(np.cos(turned_rad)) + abs(np.sin(turned_rad))
    return float(0.5 * LABEL_MARGIN * label_size_mm * turned)


def behind_the_plug(
    geometry: RobotGeometry, mount: CameraMount, R_base_camera: Array, margin_mm: float
) -> Callable[[Array], NDArray[np.bool_]]:
    """Tells which points the plug hides while it is drawn back.

    Args:
        geometry: Of the robot as drawn.
        mount: Where the camera sits on the platform.
        R_base_camera: How it is turned as far as known, shape (3, 3).
        margin_mm: Room beside the plug.
    """
    dy_mm, z_mm = gamma.tip_offset(geometry, geometry.rho3.min_mm)
    towards = np.array(geometry.insertion_axis)
    tip = np.array([0.0, dy_mm, z_mm]) - mount.T_platform_camera[:3, 3]
    return partial(
        hidden_by_plug,
        tip=tip @ R_base_camera,
        axis=towards @ R_base_camera,
        length_mm=float(z_mm / towards[2]),
        radius_mm=0.5 * geometry.plug_diameter_mm + margin_mm,
    )
