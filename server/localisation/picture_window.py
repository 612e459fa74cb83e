"""Which labels a look shows wholly, whatever the camera may be like.

The camera and the plug ride on the platform. So whether the label of a socket is in the picture
depends only on how far beside the platform the socket is: on ``beside_mm``, the way from where V
stands to where V would stand to plug in.

A camera that is turned by a little looks at another place, and there it sees the same but for its
edges. So a doubt about the camera is mostly a doubt about where the label seems to be
(``seeming_mm``), and for the rest the edges of the picture are not counted on.
"""

from __future__ import annotations

import itertools
import math

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.config.camera import CameraDoubt
from server.localisation.frames import label_from_socket
from server.localisation.known_camera import KnownCamera
from server.localisation.plug_shadow import hidden_by_plug
from server.schema.vehicles import Vehicle
from twin.geometry import RobotGeometry
from twin.kinematics import gamma

Points = NDArray[np.float64]

LABEL_MARGIN = 1.16
"""A 25-module code with the two modules around it that the reader needs, over the code alone."""
IMAGE_MARGIN_PX = 12.0
FARTHEST_SIGHT = 1.2
"""Over the way to the picture's corner: farther out the lens is not described by its numbers."""
_RIM = np.array([[-1, -1], [0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]], dtype=float)


class PictureWindow:
    """What one camera shows past one plug.

    Args:
        geometry: Of the robot.
        camera: Its doubt counts.
        vehicle: Gives the label's size and its place beside the socket.
        faces_mm: The slide reaches the socket's face between these two [mm].
        tilt_rad: The car may be turned by so much against the robot.
        cell_mm: The label may be so far beside its place, half to each side.
        rho3_mm: Of the slide while the robot looks, which decides how much the plug hides.
    """

    def __init__(
        self,
        geometry: RobotGeometry,
        camera: KnownCamera,
        vehicle: Vehicle,
        *,
        faces_mm: tuple[float, float],
        tilt_rad: float,
        cell_mm: float,
        rho3_mm: float,
    ) -> None:
        doubt = camera.doubt
        self._optics = _nearest_seeming(camera.optics, doubt)
        self._camera = camera.mount.T_platform_camera
        self._tip = np.array([0.0, *gamma.tip_offset(geometry, rho3_mm)])
        self._axis = np.array(geometry.insertion_axis)
        self._plug_radius_mm = 0.5 * geometry.plug_diameter_mm + doubt.mount_mm
        from_socket = _label_beside_socket(geometry, vehicle)
        sway_mm = float(np.linalg.norm(from_socket)) * math.sin(tilt_rad)
        # Around the label of the socket right before the plug, near and far, shape (2, 8, 3).
        faces = np.array([[0.0, *gamma.tip_offset(geometry, face)] for face in faces_mm])
        rim = _rim(geometry, vehicle, tilt_rad, cell_mm)
        self._rims = (faces + from_socket)[:, None] + rim
        self._rims[..., 2] += np.array([[-1.0], [1.0]]) * (sway_mm + doubt.mount_mm)
        self._turns = _turns(self._camera[:3, :3], doubt.turn_rad)
        ahead = self._rims.mean(axis=(0, 1)) - self._camera[:3, 3]
        # Where the label must be for a turned camera to have it where the known one would.
        self._looks_aside = self._turns @ ahead - ahead
        self._looks_aside[:, 2] = 0.0
        centre_mm = doubt.centre_px / min(self._optics.fx, self._optics.fy) * abs(ahead[2])
        steady_mm = sway_mm + doubt.mount_mm + doubt.platform_mm + centre_mm
        self.seeming_mm: Points = np.abs(self._looks_aside[:, :2]).max(axis=0) + steady_mm
        """How far beside its place the label may seem to be, shape (2,) [mm]."""

    def shows(self, beside_mm: Points) -> NDArray[np.bool_]:
        """Whether labels that seem to be there are wholly in the picture, not behind the plug.

        Args:
            beside_mm: From the platform, shape (n, 2).

        Returns:
            True where that is so for every camera within its doubt, shape (n,).
        """
        beside = np.column_stack((beside_mm, np.zeros(len(beside_mm))))
        rims = self._rims.reshape(-1, 3)
        shown = np.ones(len(beside), dtype=bool)
        for turn, aside in zip(self._turns, self._looks_aside, strict=True):
            left = np.flatnonzero(shown)
            if not len(left):
                break
            points = beside[left, None, :] + rims + aside - self._camera[:3, 3]
            fine = self._in_picture(points @ (turn @ self._camera[:3, :3]))
            fine &= ~self._behind_plug(points)
            shown[left] = fine.all(axis=1)
        return shown

    def _in_picture(self, points: Points) -> NDArray[np.bool_]:
        """Points in the camera frame, shape (..., 3)."""
        optics, ahead = self._optics, points[..., 2] > 0
        depths = np.where(ahead, points[..., 2], 1.0)
        sights = points[..., :2] / depths[..., None]
        corner = math.hypot(
            max(optics.cx, optics.width - optics.cx) / optics.fx,
            max(optics.cy, optics.height - optics.cy) / optics.fy,
        )
        lens = np.linalg.norm(sights, axis=-1) < FARTHEST_SIGHT * corner
        usable = ahead & lens
        rays = np.where(usable[..., None], sights, 0.0).reshape(-1, 2)
        still = np.zeros(3)
        pixels, _ = cv2.projectPoints(
            np.column_stack((rays, np.ones(len(rays)))), still, still, optics.matrix,
            optics.distortion,
        )  # fmt: skip
        u, v = pixels.reshape(-1, 2).T.reshape(2, *usable.shape)
        return np.asarray(
            usable
            & (u > IMAGE_MARGIN_PX)
            & (u < optics.width - 1 - IMAGE_MARGIN_PX)
            & (v > IMAGE_MARGIN_PX)
            & (v < optics.height - 1 - IMAGE_MARGIN_PX)
        )

    def _behind_plug(self, points: Points) -> NDArray[np.bool_]:
        """Points from the camera, in axes of the base, shape (..., 3)."""
        tip = self._tip - self._camera[:3, 3]
        return hidden_by_plug(
            points,
            tip=tip,
            axis=self._axis,
            length_mm=float(self._tip[2] / self._axis[2]),
            radius_mm=self._plug_radius_mm,
        )


def _label_beside_socket(geometry: RobotGeometry, vehicle: Vehicle) -> Points:
    """From the socket to the label's centre in axes of the base, shape (3,) [mm]."""
    T_label_socket = label_from_socket(vehicle.socket)
    from_socket = -(T_label_socket[:3, :3].T @ T_label_socket[:3, 3])
    return np.asarray(_facing_the_car(geometry) @ from_socket)


def _facing_the_car(geometry: RobotGeometry) -> Points:
    """R_base_label of a car that stands straight: x runs against the rail."""
    z_axis, x_axis = np.array(geometry.insertion_axis), np.array([-1.0, 0.0, 0.0])
    return np.column_stack([x_axis, np.cross(z_axis, x_axis), z_axis])


def _rim(geometry: RobotGeometry, vehicle: Vehicle, tilt_rad: float, cell_mm: float) -> Points:
    """Around a label, from its centre, in axes of the base, shape (8, 3) [mm]."""
    half_mm = 0.5 * LABEL_MARGIN * vehicle.label_size_mm * (math.cos(tilt_rad) + math.sin(tilt_rad))
    rim = half_mm * _RIM @ _facing_the_car(geometry)[:, :2].T
    rim[:, :2] += 0.5 * cell_mm * np.sign(np.round(rim[:, :2]))
    return rim


def _turns(R_platform_camera: Points, turn_rad: float) -> Points:
    """How the camera may be turned about its own axes, in axes of the base, shape (n, 3, 3)."""
    if turn_rad == 0.0:
        return np.eye(3)[None]
    corners = itertools.product((-turn_rad, turn_rad), repeat=3)
    own = [cv2.Rodrigues(np.array(corner))[0] for corner in corners]
    return np.stack([R_platform_camera @ turn @ R_platform_camera.T for turn in own])


def _nearest_seeming(optics: CameraModel, doubt: CameraDoubt) -> CameraModel:
    """The optics within the doubt that show least of the world."""
    longer = 1.0 + doubt.focal_share
    return optics.model_copy(update={"fx": optics.fx * longer, "fy": optics.fy * longer})
