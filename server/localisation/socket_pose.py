"""The socket in the base frame, with its uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.localisation.frames import Pose, label_from_socket
from server.schema.vehicles import SocketOffset
from server.vision import LabelPose
from twin.geometry import RobotGeometry
from twin.joints import TipPosition


@dataclass(frozen=True, slots=True)
class SocketPose:
    """Where the socket is.

    Attributes:
        T_base_socket: Origin in the centre of the socket's face, z along its axis into the car.
        T_base_label: The label it was derived from.
        covariance: Of the socket's origin in the base frame, shape (3, 3) [mm^2].
        measured_at_s: Event loop time of the picture.
        from_standstill: The robot stood still; a rolling shutter shifts what it sees on the way by
            tenths of a millimetre, which the covariance does not know of.
    """

    T_base_socket: Pose
    T_base_label: Pose
    covariance: NDArray[np.float64]
    measured_at_s: float
    from_standstill: bool = True

    @property
    def entry(self) -> TipPosition:
        """Where the plug's tip enters: the centre of the socket's face."""
        x, y, z = self.T_base_socket[:3, 3]
        return TipPosition(float(x), float(y), float(z))

    @property
    def axis(self) -> NDArray[np.float64]:
        """Unit vector into the car, shape (3,)."""
        axis: NDArray[np.float64] = self.T_base_socket[:3, 2]
        return axis

    def tilt_rad(self, geometry: RobotGeometry) -> float:
        """Angle between the socket's axis and the robot's insertion axis [rad]."""
        cosine = float(np.dot(self.axis, geometry.insertion_axis))
        return math.acos(min(1.0, max(-1.0, cosine)))

    @property
    def depth_sigma_mm(self) -> float:
        """Standard deviation of the origin along the axis [mm]."""
        return math.sqrt(max(0.0, float(self.axis @ self.covariance @ self.axis)))

    @property
    def lateral_sigma_mm(self) -> float:
        """Largest standard deviation of the origin across the axis [mm]."""
        across = self.T_base_socket[:3, :2]
        (xx, xy), (_, yy) = (across.T @ self.covariance @ across).tolist()
        # The larger eigenvalue of a symmetric 2x2 matrix; this is asked for with every sample.
        largest = (xx + yy) / 2 + math.hypot((xx - yy) / 2, xy)
        return math.sqrt(max(0.0, largest))


def socket_from_label(
    sighting: LabelPose, T_base_camera: Pose, offset: SocketOffset, measured_at_s: float
) -> SocketPose:
    """Carry a label's pose over to the socket.

    The socket's origin in the camera frame is R s + t with s its place in the label frame, so a
    small rotation w of the label about its own centre and a shift d move it by
    d - [R s]x w: the Jacobian that carries the label's covariance over.
    """
    T_label_socket = label_from_socket(offset)
    T_base_label = T_base_camera @ sighting.T_camera_label
    x, y, z = sighting.T_camera_label[:3, :3] @ T_label_socket[:3, 3]
    lever = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    jacobian = T_base_camera[:3, :3] @ np.hstack([-lever, np.eye(3)])
    return SocketPose(
        T_base_socket=T_base_label @ T_label_socket,
        T_base_label=T_base_label,
        covariance=jacobian @ sighting.covariance @ jacobian.T,
        measured_at_s=measured_at_s,
    )
