"""Where to look for a label that is not in the picture: as few looks as its footprint allows.

Every place where the label may be is a point of a grid over the regular box. A look is a platform
position; it sees the points whose whole label falls into the picture and is not hidden behind the
robot's own plug. Looks are taken greedily by points newly seen per second of travel.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.localisation.frames import Pose, label_from_socket
from server.schema.vehicles import Vehicle
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.kinematics import gamma

LABEL_STEP_MM = 10.0
LOOK_STEP_MM = 20.0
LOOK_MARGIN_MM = 80.0
"""How far outside the regular box the platform may go to see more."""
MARGIN = 1.16
"""A 25-module code with the two modules around it that the reader needs, over the code alone."""
IMAGE_MARGIN_PX = 12.0
SECONDS_PER_LOOK = 0.4
TRAVEL_MM_S = 60.0

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Look:
    """A platform position to look from, and the share of possible labels it adds."""

    x_mm: float
    y_mm: float
    share: float


class LookPlanner:
    """Plans looks for one robot and one vehicle.

    Args:
        geometry: Of the robot.
        mount: Of the camera.
        optics: Of the camera.
        vehicle: Gives the label's size and its place beside the socket.
        insertion_depth_mm: The slide must still reach this far behind the socket's face.
        approach_mm: And start this far before it.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        mount: CameraMount,
        optics: CameraModel,
        vehicle: Vehicle,
        *,
        insertion_depth_mm: float,
        approach_mm: float,
    ) -> None:
        self._geometry = geometry
        self._mount = mount
        self._optics = optics
        self._half_label_mm = 0.5 * MARGIN * vehicle.label_size_mm
        face_rho3_mm = 0.5 * (
            geometry.rho3.min_mm + approach_mm + geometry.rho3.max_mm - insertion_depth_mm
        )
        self._labels = self._possible_labels(vehicle, face_rho3_mm)
        self._candidates = self._reachable_platforms()

    def looks(self, x_mm: float, y_mm: float, rho3_mm: float) -> Iterator[Look]:
        """Looks in the order to take them, beginning where the platform stands.

        Args:
            x_mm: Of the platform now.
            y_mm: Of the platform now.
            rho3_mm: Of the slide, which decides how much the plug hides.
        """
        here = np.array([x_mm, y_mm])
        unseen = np.ones(len(self._labels), dtype=bool)
        seen_from = np.array([self._sees(place, rho3_mm) for place in self._candidates])
        look, seen = here, self._sees(here, rho3_mm)
        while True:
            yield Look(float(look[0]), float(look[1]), float((seen & unseen).mean()))
            unseen &= ~seen
            gains = (seen_from & unseen).sum(axis=1)
            if not gains.any():
                return
            travel_s = np.linalg.norm(self._candidates - look, axis=1) / TRAVEL_MM_S
            best = int(np.argmax(gains / (SECONDS_PER_LOOK + travel_s)))
            look, seen = self._candidates[best], seen_from[best]

    def _possible_labels(self, vehicle: Vehicle, face_rho3_mm: float) -> Points:
        """Label centres in the base frame for every socket in the regular box, shape (n, 3)."""
        box, axis = self._geometry.regular_box, self._geometry.insertion_axis
        xs = _steps(box.center_x_mm, box.width_mm / 2, LABEL_STEP_MM)
        ys = _steps(box.center_y_mm, box.height_mm / 2, LABEL_STEP_MM)
        T_label_socket = label_from_socket(vehicle.socket)
        # Seen by the robot: the label's z is the insertion axis, its x runs against the rail.
        z_axis = np.array(axis)
        x_axis = np.array([-1.0, 0.0, 0.0])
        R_base_label = np.column_stack([x_axis, np.cross(z_axis, x_axis), z_axis])
        from_socket = R_base_label @ -(T_label_socket[:3, :3].T @ T_label_socket[:3, 3])
        places = np.array([[x, y, 0.0] for x in xs for y in ys])
        return places + _tip(self._geometry, 0.0, 0.0, face_rho3_mm) + from_socket

    def _reachable_platforms(self) -> Points:
        """Platform positions to choose from, shape (n, 2)."""
        box = self._geometry.regular_box
        xs = _steps(box.center_x_mm, box.width_mm / 2 + LOOK_MARGIN_MM, LOOK_STEP_MM)
        ys = _steps(box.center_y_mm, box.height_mm / 2 + LOOK_MARGIN_MM, LOOK_STEP_MM)
        places = np.array([[x, y] for x in xs for y in ys])
        slide_mm = self._geometry.rho3.min_mm
        tips = np.array([_tip(self._geometry, x, y, slide_mm) for x, y in places])
        joints = gamma.inverse_many(self._geometry, tips)
        return places[gamma.within_limits_many(self._geometry, joints)]

    def _sees(self, platform: Points, rho3_mm: float) -> NDArray[np.bool_]:
        """Which possible labels are wholly in the picture and not behind the plug, shape (n,)."""
        T_base_camera = self._mount.T_platform_camera
        T_base_camera[:2, 3] += platform
        to_label = self._labels - T_base_camera[:3, 3]
        h = self._half_label_mm
        corners = np.array([[-h, -h, 0.0], [h, -h, 0.0], [h, h, 0.0], [-h, h, 0.0]])
        # Corners square to the picture: the tilt of a parked car moves them by under a margin.
        rays = (to_label @ T_base_camera[:3, :3])[:, None, :] + corners
        u = self._optics.fx * rays[..., 0] / rays[..., 2] + self._optics.cx
        v = self._optics.fy * rays[..., 1] / rays[..., 2] + self._optics.cy
        inside = (
            (rays[..., 2] > 0)
            & (u > IMAGE_MARGIN_PX)
            & (u < self._optics.width - 1 - IMAGE_MARGIN_PX)
            & (v > IMAGE_MARGIN_PX)
            & (v < self._optics.height - 1 - IMAGE_MARGIN_PX)
        )
        hidden = self._behind_plug(rays, T_base_camera, platform, rho3_mm)
        return np.asarray((inside & ~hidden).all(axis=1))

    def _behind_plug(
        self, rays: Points, T_base_camera: Pose, platform: Points, rho3_mm: float
    ) -> NDArray[np.bool_]:
        """Whether the line of sight to a point passes through the plug, shape of ``rays[..., 0]``.

        The plug is a cylinder from the platform to the tip. Where the sight line crosses the
        plane in which camera and plug axis lie nearest, the distance of the two lines decides.
        """
        geometry = self._geometry
        tip = _tip(geometry, platform[0], platform[1], rho3_mm)
        axis = np.array(geometry.insertion_axis)
        to_camera = T_base_camera[:3, :3].T
        tip_c, axis_c = to_camera @ (tip - T_base_camera[:3, 3]), to_camera @ axis
        length_mm = tip[2] / axis[2]
        sight = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
        # Nearest points of the sight line (s along it) and the plug's axis (t back from the tip),
        # both limited to where the plug really is.
        along = sight @ axis_c
        denominator = np.maximum(1.0 - along**2, 1e-9)
        s = (sight @ tip_c - along * (tip_c @ axis_c)) / denominator
        t = np.clip(s * along - tip_c @ axis_c, -length_mm, 0.0)
        nearest = tip_c + t[..., None] * axis_c
        s = np.clip((nearest * sight).sum(axis=-1), 0.0, None)
        gap = np.linalg.norm(s[..., None] * sight - nearest, axis=-1)
        return np.asarray(gap < 0.5 * geometry.plug_diameter_mm)


def _steps(center: float, half: float, step: float) -> Points:
    count = max(1, round(2 * half / step))
    return np.linspace(center - half, center + half, count + 1)


def _tip(geometry: RobotGeometry, x_mm: float, y_mm: float, rho3_mm: float) -> Points:
    """Plug tip for a platform position, in the base frame, shape (3,)."""
    dy_mm, z_mm = gamma.tip_offset(geometry, rho3_mm)
    return np.array([x_mm, y_mm + dy_mm, z_mm])
