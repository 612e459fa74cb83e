"""The chain of frames from the base to the socket.

T_a_b is a homogeneous transform of shape (4, 4) with its translation in mm; it maps coordinates
in b to coordinates in a.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from server.schema.vehicles import SocketOffset
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

Pose = NDArray[np.float64]


def base_from_camera(geometry: RobotGeometry, mount: CameraMount, joints: JointPosition) -> Pose:
    """T_base_camera for a robot posture: the platform only translates, the camera rides on it."""
    platform = gamma.platform(geometry, joints)
    pose = mount.T_platform_camera
    pose[0, 3] += platform.x_mm
    pose[1, 3] += platform.y_mm
    return pose


def label_from_socket(offset: SocketOffset) -> Pose:
    """T_label_socket: turned about the label's x, then about its y, then shifted."""
    sx, cx = math.sin(offset.rotation_x_rad), math.cos(offset.rotation_x_rad)
    sy, cy = math.sin(offset.rotation_y_rad), math.cos(offset.rotation_y_rad)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cx, -sx], [0.0, sx, cx]])
    about_y = np.array([[cy, 0.0, sy], [0.0, 1.0, 0.0], [-sy, 0.0, cy]])
    pose = np.eye(4)
    pose[:3, :3] = about_y @ about_x
    pose[:3, 3] = offset.x_mm, offset.y_mm, offset.z_mm
    return pose


def inverse(pose: Pose) -> Pose:
    """The inverse of a rigid transform: T_b_a from T_a_b."""
    rotation = pose[:3, :3].T
    result = np.eye(4)
    result[:3, :3] = rotation
    result[:3, 3] = -rotation @ pose[:3, 3]
    return result
