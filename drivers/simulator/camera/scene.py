"""The light that comes from the scene to every pixel, before the sensor."""

from __future__ import annotations

import cv2
import numpy as np

from drivers.camera import CameraModel
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_texture import label_reflectance
from drivers.simulator.camera.plug_silhouette import draw_plug
from drivers.simulator.camera.ray_grid import RayGrid
from drivers.simulator.camera.socket_texture import socket_texture
from drivers.simulator.camera.textured_plane import (
    Canvas,
    PlaneTexture,
    draw_plane,
)
from drivers.simulator.view import CameraView, Pose
from twin.qr_label import label_modules

_COARSE_PX = 16
_NEAREST_MM = 10.0
_SMALLEST_PX = 12.0  # things that look smaller are left out
_BODY_WITHIN_MM = 5_000.0  # no car nearer than this: the garage is empty
_EMPTY_GARAGE_REFLECTANCE = 0.18
_MOST_TEXELS_PER_MODULE = 40


class SceneRenderer:
    """Draws car body, socket, label and plug into one canvas that it keeps.

    Not for use by several threads at once.
    """

    def __init__(self, optics: CameraModel, imaging: ImagingParameters) -> None:
        self._optics = optics
        self._imaging = imaging
        self._grid = RayGrid(optics)
        self._coarse_rays = self._grid.coarse(_COARSE_PX)
        self._socket = socket_texture()
        self._canvas: Canvas = np.zeros((optics.height, optics.width), dtype=np.float32)

    @property
    def grid(self) -> RayGrid:
        """Rays of the camera."""
        return self._grid

    def render(self, view: CameraView) -> Canvas:
        """Reflectance seen by every pixel, shape (height, width); valid until the next call.

        Raises:
            ValueError: the payload does not fit into a QR code.
        """
        self._draw_body(view.T_camera_socket)
        self._draw_flat(self._socket, view.T_camera_socket, view)
        self._draw_flat(self._label_texture(view), view.T_camera_label, view)
        tip_mm = max(float(view.T_camera_plug[2, 3]), 30.0)
        draw_plug(
            self._canvas,
            self._optics,
            view.T_camera_plug,
            view.T_camera_socket,
            self._imaging.blur_px(tip_mm, self._optics),
        )
        return self._canvas

    def _draw_flat(self, texture: PlaneTexture, pose: Pose, view: CameraView) -> None:
        """Draw a plane that moves with the car."""
        distance_mm = float(pose[2, 3])
        if distance_mm < _NEAREST_MM:
            return
        px_per_mm = self._optics.fx / distance_mm
        if texture.alpha.shape[0] * texture.texel_mm * px_per_mm < _SMALLEST_PX:
            return
        way = pose[:3, :3].T @ view.label_velocity_mm_s * self._imaging.exposure_s
        blurred = texture.blurred(
            self._imaging.blur_px(distance_mm, self._optics),
            (float(way[0]), float(way[1])),
            px_per_mm,
        )
        draw_plane(self._canvas, self._optics, self._grid, blurred, pose)

    def _label_texture(self, view: CameraView) -> PlaneTexture:
        """The label, finer than its blur."""
        modules = label_modules(view.payload)
        module_mm = view.label_size_mm / modules.shape[0]
        distance_mm = max(float(view.T_camera_label[2, 3]), _NEAREST_MM)
        module_px = self._optics.fx / distance_mm * module_mm
        texels_per_px = 0.5 + 0.8 / self._imaging.blur_px(distance_mm, self._optics)
        texels = int(np.clip(np.ceil(texels_per_px * module_px), 3, _MOST_TEXELS_PER_MODULE))
        reflectance = label_reflectance(
            modules, texels, self._imaging.black_reflectance, self._imaging.white_reflectance
        )
        return PlaneTexture(reflectance, np.ones_like(reflectance), module_mm / texels)

    def _draw_body(self, T_camera_socket: Pose) -> None:
        """Painted sheet metal in the socket's plane: soft shading of a curved panel with a crease.

        Everything about it is smooth, so every sixteenth pixel is enough.
        """
        if not _NEAREST_MM < T_camera_socket[2, 3] < _BODY_WITHIN_MM:
            self._canvas.fill(_EMPTY_GARAGE_REFLECTANCE)
            return
        toward = np.linalg.inv(T_camera_socket[:3, (0, 1, 3)])
        x, y = np.moveaxis(cv2.perspectiveTransform(self._coarse_rays, toward), -1, 0)
        shade = 0.34 + 0.05 * np.sin(x / 310 + 0.4) - 0.09 * np.tanh((y + 150) / 45)
        shade += 0.07 * np.exp(-(((y + 0.12 * x + 210) / 38) ** 2))
        shade = np.clip(np.nan_to_num(shade, nan=0.2), 0.05, 0.9).astype(np.float32)
        rows, columns = self._canvas.shape
        enlarge = np.array([[1 / _COARSE_PX, 0.0, 0.0], [0.0, 1 / _COARSE_PX, 0.0]])
        cv2.warpAffine(
            shade,
            enlarge,
            (columns, rows),
            dst=self._canvas,
            flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
            borderMode=cv2.BORDER_REPLICATE,
        )
