"""Whether the opposite tilt would fit about as well, asked of a fit that came from one start.

The picture need not be looked at again: the edges have been measured, and where another pose has
them follows from geometry.
"""

from __future__ import annotations

import math

import numpy as np

from drivers.camera import CameraModel
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.edge_fit import EdgeFit
from server.vision.fitting.two_poses import CLEARLY_WORSE, SAME_POSE_RAD, is_plain, turn_rad
from server.vision.projection import Array, perturbed, project

_STEPS = 3


def may_be_opposite(camera: CameraModel, edges: CodeEdges, fit: EdgeFit) -> bool:
    """Whether the opposite tilt explains the measured edges about as well as a fit does.

    Args:
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        fit: The fit from one start.
    """
    pose = fit.T_camera_label
    if is_plain(camera, pose, fit.rms_px, edges):
        return False
    start = _opposite(pose)
    if turn_rad(start, pose) < SAME_POSE_RAD:
        return False
    other, rms_px = _fitted(camera, edges, fit, start)
    return turn_rad(other, pose) >= SAME_POSE_RAD and rms_px < CLEARLY_WORSE * fit.rms_px


def _fitted(
    camera: CameraModel, edges: CodeEdges, fit: EdgeFit, start: Array
) -> tuple[Array, float]:
    """Gauss-Newton from another start on the edges as they were measured, with their weights.

    Returns:
        The pose, and the root mean square of what is left [px].
    """
    solved = fit.solved
    points = edges.points_mm[solved.used]
    normal, gain = fit.measured.normal[:, solved.used], fit.measured.gain[solved.used]
    others = solved.design.T[6:]
    weights = solved.weights / solved.scale_px**2
    along = (project(camera, fit.T_camera_label, points).u_v * normal).sum(axis=0)
    measured = gain * along + solved.residuals
    pose, rest = start, solved.residuals
    for _ in range(_STEPS):
        seen = project(camera, pose, points)
        offsets = measured - gain * (seen.u_v * normal).sum(axis=0)
        columns = np.concatenate((seen.by_pose_along(normal) * gain, others))
        weighted = columns * weights
        step = np.linalg.solve(weighted @ columns.T, weighted @ offsets)
        pose, rest = perturbed(pose, step[:6]), offsets - step @ columns
    rms_px = math.sqrt(float(solved.weights @ rest**2) / float(solved.weights.sum()))
    return pose, rms_px


def _opposite(pose: Array) -> Array:
    """The pose with its normal mirrored at the line of sight."""
    sight = pose[:3, 3] / np.linalg.norm(pose[:3, 3])
    normal = pose[:3, 2]
    axis = np.cross(normal, sight)
    sine = float(np.linalg.norm(axis))
    if sine == 0.0:
        return pose
    angle = 2 * math.atan2(sine, float(normal @ sight))
    return perturbed(pose, np.concatenate((axis * (angle / sine), np.zeros(3))))
