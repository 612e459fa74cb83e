"""The light that comes from the scene to every pixel, before the sensor."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from drivers.camera import CameraModel
from drivers.simulator.camera.car_plane import CarPaint, CarPlane, car_plane
from drivers.simulator.camera.coarse_grid import CoarseGrid, Field, coarse_grid
from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.held_sheet import PlacedSheet
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_condition import LabelCondition
from drivers.simulator.camera.label_texture import LabelPainter
from drivers.simulator.camera.lighting import (
    PAINT_ROUGHNESS_RAD,
    Light,
    Lighting,
    reflections,
)
from drivers.simulator.camera.panel_drops import panel_drops
from drivers.simulator.camera.plug_silhouette import draw_plug
from drivers.simulator.camera.row_motion import RowMotion
from drivers.simulator.camera.socket_texture import socket_texture
from drivers.simulator.camera.textured_plane import (
    STRIDE_PX,
    Canvas,
    PlacedPlane,
    PlaneTexture,
    draw_plane,
)
from drivers.simulator.view import CameraView
from twin.qr_label import label_modules

COARSE_PX = 8
_NEAREST_MM = 10.0
_SMALLEST_PX = 12.0  # things that look smaller are left out
_BODY_WITHIN_MM = 5_000.0  # no car nearer than this: the garage is empty
_EMPTY_GARAGE_REFLECTANCE = 0.18
_MOST_TEXELS_PER_MODULE = 40
_WHITE = 0.85  # brightness of a reflection is relative to a white surface
_LEAST_LIGHT = 1e-6
_KEPT_TEXTURES = 8
_SHEET_STEP = 0.02


class Exposed(NamedTuple):
    """What reaches the lens.

    Attributes:
        canvas: Reflectance of every pixel, reflections included, shape (height, width); valid
            until the next picture.
        light: Light times the lens's fall-off at the nodes of the grid.
    """

    canvas: Canvas
    light: Field


class SceneRenderer:
    """Draws car body, socket, label and plug into one canvas that it keeps.

    Not for use by several threads at once.

    Args:
        optics: The true optics.
        imaging: Blur and light.
        conditions: What label, lamps and weather are like.
        seed: Determines the label.
    """

    def __init__(
        self,
        optics: CameraModel,
        imaging: ImagingParameters,
        conditions: Conditions = FLAWLESS,
        seed: int = 0,
    ) -> None:
        self._optics = optics
        self._imaging = imaging
        self._conditions = conditions
        self._rays = coarse_grid(optics, STRIDE_PX)
        self._grid = coarse_grid(optics, COARSE_PX)
        self._lighting = Lighting(imaging, conditions.lamps, optics, self._grid)
        self._label = LabelPainter(imaging, conditions, seed)
        self._paint = CarPaint()
        self._socket = socket_texture()
        self._drops = panel_drops(conditions.rain, seed)
        self._kept: OrderedDict[Hashable, PlaneTexture] = OrderedDict()
        self._canvas: Canvas = np.zeros((optics.height, optics.width), dtype=np.float32)

    @property
    def grid(self) -> CoarseGrid:
        """Where smooth things are worked out."""
        return self._grid

    @property
    def label_condition(self) -> LabelCondition:
        """Size and shape of the label in the scene."""
        return self._label.condition

    def draw_label(self, condition: LabelCondition) -> None:
        """Draw a label of another size and shape from now on."""
        self._label.condition = condition
        self._kept.clear()

    def render(
        self,
        view: CameraView,
        *,
        ambient: float | None = None,
        exposure_s: float | None = None,
        sheet: PlacedSheet | None = None,
    ) -> Exposed:
        """Reflectance and light seen by every pixel.

        Args:
            view: The true scene in the middle of the frame.
            ambient: Brightness of the ambient light; None as configured.
            exposure_s: None as configured.
            sheet: Held between camera and car; it is lit as what lies behind it.

        Raises:
            ValueError: the payload does not fit into a QR code.
        """
        imaging = self._imaging
        ambient = imaging.ambient if ambient is None else ambient
        exposure_s = imaging.exposure_s if exposure_s is None else exposure_s
        rows = RowMotion(view, imaging.readout_s, self._optics.height)
        socket = view.T_camera_socket
        if not _NEAREST_MM < socket[2, 3] < _BODY_WITHIN_MM:
            self._canvas.fill(_EMPTY_GARAGE_REFLECTANCE)
            light = self._lighting.at(None, socket, ambient)
        else:
            car = car_plane(self._grid, socket, rows)
            light = self._lighting.at(car, socket, ambient)
            self._draw_car(car, light, view, rows, exposure_s)
        if sheet is not None:
            self._draw_sheet(sheet, view, exposure_s)
        tip_mm = max(float(view.T_camera_plug[2, 3]), 30.0)
        sigma_px = imaging.blur_px(tip_mm, self._optics)
        draw_plug(self._canvas, self._optics, view.T_camera_plug, socket, sigma_px)
        return Exposed(self._canvas, light.on_car)

    def _draw_car(
        self, car: CarPlane, light: Light, view: CameraView, rows: RowMotion, exposure_s: float
    ) -> None:
        shade = self._paint.diffuse(car)
        if light.lamps:
            shade = shade + self._gloss(car, light, self._paint.slopes(car), PAINT_ROUGHNESS_RAD)
        np.copyto(self._canvas, self._grid.enlarged(shade))

        def draw(key: Hashable, make: Callable[[], PlaneTexture], plane: PlacedPlane) -> None:
            pose = plane.T_camera_plane
            way = pose[:3, :3].T @ view.label_velocity_mm_s * exposure_s
            texture = self._blurred(key, make, float(pose[2, 3]))
            if texture is not None:
                smeared = texture.smeared((float(way[0]), float(way[1])))
                draw_plane(self._canvas, self._rays, smeared, plane, rows)

        socket, label = view.T_camera_socket, view.T_camera_label
        draw("socket", lambda: self._socket, PlacedPlane(socket))
        drops = self._drops
        if drops is not None:
            draw("drops", lambda: drops, PlacedPlane(socket))
        if not _NEAREST_MM < label[2, 3] < _BODY_WITHIN_MM:
            return
        gloss, roughness_rad = self._conditions.label.gloss, self._conditions.label.roughness_rad
        shine = None
        if light.lamps and gloss:
            field = self._gloss(car, light, (0.0, 0.0), roughness_rad)
            shine = (self._grid, field * np.float32(gloss))
        texels = self._texels(view)
        key = (view.payload, view.label_size_mm, texels)
        half_mm = view.label_size_mm / 2 * 1.16
        draw(
            key,
            lambda: self._label.texture(view.payload, view.label_size_mm, texels),
            PlacedPlane(label, self._label.condition, half_mm, shine),
        )

    def _draw_sheet(self, sheet: PlacedSheet, view: CameraView, exposure_s: float) -> None:
        pose, imaging = sheet.T_camera_sheet, self._imaging
        distance_mm = float(pose[2, 3])
        if distance_mm < _NEAREST_MM:
            return
        px_per_mm = self._optics.fx / distance_mm
        # A hand is never at its distance of before: blurred anew only where that is to be seen.
        key = ("sheet", sheet.texture, round(math.log(px_per_mm) / _SHEET_STEP))
        if key not in self._kept:
            disc_px = imaging.disc_px(distance_mm, self._optics)
            self._keep(key, sheet.texture.blurred(imaging.lens_blur_px, disc_px, px_per_mm))
        way = pose[:3, :3].T @ sheet.velocity_mm_s * exposure_s
        smeared = self._kept[key].smeared((float(way[0]), float(way[1])))
        moving = replace(view, row_way=sheet.way)
        rows = RowMotion(moving, imaging.readout_s, self._optics.height)
        draw_plane(self._canvas, self._rays, smeared, PlacedPlane(pose), rows)

    def _gloss(
        self,
        car: CarPlane,
        light: Light,
        slopes: tuple[Field | float, Field | float],
        roughness_rad: float,
    ) -> Field:
        """Reflections of lamps as the reflectance that would look the same in this light."""
        shine = reflections(light, car.places_mm, car.mirrored(*slopes), roughness_rad)
        return np.asarray(_WHITE * shine / np.maximum(light.on_car, _LEAST_LIGHT), np.float32)

    def _blurred(
        self, key: Hashable, make: Callable[[], PlaneTexture], distance_mm: float
    ) -> PlaneTexture | None:
        """A texture as the lens blurs it; kept, because the camera mostly stays at its distance.

        None where it would be too small to see.
        """
        if distance_mm < _NEAREST_MM:
            return None
        imaging, optics = self._imaging, self._optics
        px_per_mm = round(optics.fx / distance_mm, 4)
        whole = (key, px_per_mm)
        if whole not in self._kept:
            texture = make()
            if texture.alpha.shape[0] * texture.texel_mm * px_per_mm < _SMALLEST_PX:
                return None
            disc_px = imaging.disc_px(distance_mm, optics)
            self._keep(whole, texture.blurred(imaging.lens_blur_px, disc_px, px_per_mm))
        self._kept.move_to_end(whole)
        return self._kept[whole]

    def _keep(self, key: Hashable, texture: PlaneTexture) -> None:
        self._kept[key] = texture
        if len(self._kept) > _KEPT_TEXTURES:
            self._kept.popitem(last=False)

    def _texels(self, view: CameraView) -> int:
        """Texels per module that are finer than the label's blur."""
        modules = label_modules(view.payload)
        module_mm = view.label_size_mm / modules.shape[0]
        distance_mm = max(float(view.T_camera_label[2, 3]), _NEAREST_MM)
        module_px = self._optics.fx / distance_mm * module_mm
        texels_per_px = 0.5 + 0.8 / self._imaging.blur_px(distance_mm, self._optics)
        return int(np.clip(np.ceil(texels_per_px * module_px), 3, _MOST_TEXELS_PER_MODULE))
