"""Why a label that was followed is no longer seen: which way it left the picture, if it did."""

from __future__ import annotations

import math

import numpy as np

from drivers.camera import CameraModel
from server.guidance.model import Array, Direction
from server.guidance.track import CarTrack
from server.localisation.frames import Pose, inverse
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

_LABEL_MM = 36.0
"""From the middle of a label to the end of its white margin."""

_INSTANTS = 5


class Vanishing:
    """Knows what the camera does not see.

    Args:
        optics: Of the camera.
        geometry: Of the robot, whose own plug hides a part of the picture.
    """

    def __init__(self, optics: CameraModel, geometry: RobotGeometry) -> None:
        self._optics = optics
        self._geometry = geometry

    def direction(
        self, track: CarTrack, within_s: float, T_base_camera: Pose, joints: JointPosition
    ) -> Direction | None:
        """Which way the label left; None if it should still be seen.

        Args:
            track: The car as it was followed.
            within_s: How long after its last sighting it may have left.
            T_base_camera: Where the camera is.
            joints: Where the robot stands.
        """
        for later_s in np.linspace(0.0, within_s, _INSTANTS).tolist():
            label = track.label_at(track.last.at_s + later_s)[:3, 3]
            aside = label - T_base_camera[:3, 3]
            if aside[2] <= 0:
                return None
            upright = self._beyond_edge(label, T_base_camera)
            if upright is None and self._behind_plug(label, T_base_camera, joints):
                upright = False
            if upright is not None:
                return _side(aside, upright=upright, faces_robot=track.faces_robot)
        return None

    def _beyond_edge(self, label: Array, T_base_camera: Pose) -> bool | None:
        """Whether the label is out of the picture at its top or bottom; None if it is in it."""
        x, y, z = (inverse(T_base_camera) @ np.append(label, 1.0))[:3]
        optics = self._optics
        half_px = optics.fx * _LABEL_MM / z
        beyond_u = abs(optics.fx * x / z) + half_px - optics.width / 2
        beyond_v = abs(optics.fy * y / z) + half_px - optics.height / 2
        return None if max(beyond_u, beyond_v) < 0 else bool(beyond_v > beyond_u)

    def _behind_plug(self, label: Array, T_base_camera: Pose, joints: JointPosition) -> bool:
        """Whether a line of sight to the label comes too near to the plug's tip."""
        platform = gamma.platform(self._geometry, joints)
        rise_mm, tip_z_mm = gamma.tip_offset(self._geometry, joints.rho3_mm)
        camera = T_base_camera[:3, 3]
        share = (tip_z_mm - camera[2]) / (label[2] - camera[2])
        crossing = camera + share * (label - camera)
        away_mm = math.hypot(
            float(crossing[0]) - platform.x_mm, float(crossing[1]) - platform.y_mm - rise_mm
        )
        nearest_mm = self._geometry.plug_diameter_mm / 2 + float(share) * _LABEL_MM
        return away_mm < nearest_mm


def _side(aside: Array, *, upright: bool, faces_robot: bool) -> Direction:
    if upright:
        return Direction.UP if aside[1] > 0 else Direction.DOWN
    return Direction.RIGHT if (aside[0] > 0) == faces_robot else Direction.LEFT
