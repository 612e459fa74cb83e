"""Pose of the label from the four corners of its code: where the edge fit starts."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.projection import Array, project, undistort


class StartPose(NamedTuple):
    """One of the two poses that explain four corners.

    Attributes:
        T_camera_label: Pose, shape (4, 4), translation [mm].
        corner_rms_px: Root mean square distance of the corners [px].
    """

    T_camera_label: Array
    corner_rms_px: float


def corners_mm(label_size_mm: float) -> Array:
    """Corners of the code in label coordinates, in the order of Code.corners_px, shape (4, 3)."""
    half = label_size_mm / 2
    return np.array([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0.0)])


def start_poses(
    camera: CameraModel, corners_px: NDArray[np.float64], label_size_mm: float
) -> list[StartPose]:
    """Solve the square (IPPE, Collins and Bartoli 2014), best pose first.

    Four corners leave two poses, which differ in the sign of the tilt. Poses behind the camera
    are left out; the list is empty for corners that no label in front of it can give.
    """
    rays = undistort(camera, corners_px)
    model = corners_mm(label_size_mm)
    # IPPE_SQUARE wants y up and the order top left, top right, bottom right, bottom left.
    upright = model * np.array([1.0, -1.0, 1.0])
    count, turns, shifts, _ = cv2.solvePnPGeneric(
        upright, rays, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE_SQUARE
    )
    found = []
    for turn, shift in zip(turns[:count], shifts[:count], strict=True):
        pose = np.eye(4)
        # Columns y and z change sign: from y up, z to the camera to y down, z into the car.
        pose[:3, :3] = np.asarray(cv2.Rodrigues(turn)[0]) @ np.diag([1.0, -1.0, -1.0])
        pose[:3, 3] = np.asarray(shift).ravel()
        if not np.all(np.isfinite(pose)):
            continue
        in_front = (model @ pose[:3, :3].T + pose[:3, 3])[:, 2] > 0
        if pose[2, 2] > 0 and np.all(in_front):
            misses = project(camera, pose, model).pixels - corners_px
            found.append(StartPose(pose, float(np.sqrt(np.mean(np.sum(misses**2, axis=1))))))
    return sorted(found, key=lambda start: start.corner_rms_px)
