"""A coarse pose from the four corners of a code."""

from __future__ import annotations

import numpy as np

from drivers.camera import CameraModel
from server.vision.errors import FitFailedError, MirroredCodeError
from server.vision.fitting.start_pose import corners_mm, start_poses
from server.vision.label_pose import LabelPose, PoseSource
from server.vision.markers.code import Code
from server.vision.projection import project

CORNER_SIGMA_PX = 1.0
"""Corners are read in whole pixels; measured about 1 px off at close range."""


def corner_pose(camera: CameraModel, code: Code, label_size_mm: float) -> LabelPose:
    """Solve the square of the corners and propagate their residuals into the covariance.

    Args:
        camera: Intrinsics and distortion.
        code: The code with its corners.
        label_size_mm: Outer side of the code without its quiet zone.

    Raises:
        FitFailedError: no label in front of the camera has these corners.
        MirroredCodeError: the code is mirrored.
    """
    if code.mirrored:
        raise MirroredCodeError(f"The code {code.payload!r} is mirrored.")
    starts = start_poses(camera, code.corners_px, label_size_mm)
    if not starts:
        detail = f"The corners of the code {code.payload!r} are not those of a square."
        raise FitFailedError(detail)
    best = starts[0]
    by_pose = project(camera, best.T_camera_label, corners_mm(label_size_mm)).by_pose
    design = by_pose.reshape(8, 6)
    # Eight numbers measured, six fitted: two are left to tell the error of one.
    sigma = max(CORNER_SIGMA_PX, best.corner_rms_px * np.sqrt(2))
    covariance = np.asarray(sigma**2 * np.linalg.inv(design.T @ design), dtype=np.float64)
    # The other pose explains the corners nearly as well: the tilt may be the opposite one.
    for other in starts[1:]:
        if other.corner_rms_px < best.corner_rms_px + CORNER_SIGMA_PX:
            turn = other.T_camera_label[:3, 2] - best.T_camera_label[:3, 2]
            axis = np.cross(best.T_camera_label[:3, 2], turn)
            covariance[:3, :3] += np.outer(axis, axis)
    return LabelPose(
        payload=code.payload,
        T_camera_label=best.T_camera_label,
        covariance=covariance,
        rms_px=best.corner_rms_px,
        inlier_share=1.0,
        edge_count=4,
        spread_px=0.0,
        source=PoseSource.CORNERS,
    )
