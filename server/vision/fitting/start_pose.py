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
    """Solve for the plane (IPPE, Collins and Bartoli 2014), best pose first.

    Four corners leave two poses, which differ in the sign of the tilt. Poses behind the camera
    are left out; the list is empty for corners that no label in front of it can give.
    """
    rays = undistort(camera, corners_px)
    model = corners_mm(label_size_mm)
    # Not IPPE_SQUARE: OpenCV 5.0 loses the right solution of a label that is exactly head-on.
    count, turns, shifts, _ = cv2.solvePnPGeneric(
        model, rays, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
    )
    found = []
    for turn, shift in zip(turns[:count], shifts[:count], strict=True):
        pose = np.eye(4)
        pose[:3, :3] = cv2.Rodrigues(turn)[0]
        pose[:3, 3] = np.asarray(shift).ravel()
        if not np.all(np.isfinite(pose)):
            continue
        in_front = (model @ pose[:3, :3].T + pose[:3, 3])[:, 2] > 0
        if pose[2, 2] > 0 and np.all(in_front):
            misses = project(camera, pose, model).pixels - corners_px
            found.append(StartPose(pose, float(np.sqrt(np.mean(np.sum(misses**2, axis=1))))))
    return sorted(found, key=lambda start: start.corner_rms_px)
