"""Scene and sensor together: a view becomes a picture."""

from __future__ import annotations

from threading import Lock

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.auto_exposure import ExposureSetting, fixed_setting
from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.held_sheet import PlacedSheet
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_condition import LabelCondition
from drivers.simulator.camera.rain_drops import lens_drop_cover
from drivers.simulator.camera.scene import SceneRenderer
from drivers.simulator.camera.sensor import Sensor
from drivers.simulator.view import CameraView


class Renderer:
    """Renders what a camera with the given true optics would see.

    Pixel centres are at integer coordinates. Edges are prefiltered, so a measured place is off
    by what the measurement does wrong, not by the renderer. Threads wait for one another.

    Args:
        optics: The true optics.
        imaging: Blur, light, noise.
        seed: Of the noise, and of what became of the label.
        conditions: What label, lamps and weather are like; a flawless label if not given.
    """

    def __init__(
        self,
        optics: CameraModel,
        imaging: ImagingParameters,
        seed: int,
        conditions: Conditions = FLAWLESS,
    ) -> None:
        self._imaging = imaging
        self._usual = fixed_setting(imaging, usual_light(imaging, conditions))
        self._drawing = Lock()
        self._scene = SceneRenderer(optics, imaging, conditions, seed)
        rng = np.random.default_rng((seed, 0x61A55))
        cover = lens_drop_cover(imaging, conditions.rain, self._scene.grid, rng)
        self._sensor = Sensor(optics, imaging, self._scene.grid, cover, seed)

    @property
    def label_condition(self) -> LabelCondition:
        """Size and shape of the label that it draws."""
        return self._scene.label_condition

    def draw_label(self, condition: LabelCondition) -> None:
        """Draw a label of another size and shape from now on."""
        with self._drawing:
            self._scene.draw_label(condition)

    def picture(
        self,
        view: CameraView,
        sequence: int,
        *,
        setting: ExposureSetting | None = None,
        light: float = 1.0,
        dark: bool = False,
        sheet: PlacedSheet | None = None,
    ) -> NDArray[np.uint8]:
        """Render a frame.

        Args:
            view: The true scene in the middle of the frame.
            sequence: Number of the frame; with the seed it determines the noise.
            setting: Exposure time and gain; None as set for the usual light.
            light: Ambient light over the configured one.
            dark: No light reaches the sensor.
            sheet: Held before the camera.

        Returns:
            Grey values, shape (height, width).
        """
        setting = setting or self._usual
        ambient = self._imaging.ambient * light
        with self._drawing:  # a picture whose asker was cancelled may still be in the making
            exposed = self._scene.render(
                view, ambient=ambient, exposure_s=setting.exposure_s, sheet=sheet
            )
            if dark:
                exposed = exposed._replace(light=np.zeros_like(exposed.light))
            return self._sensor.expose(exposed, sequence, setting)


def usual_light(imaging: ImagingParameters, conditions: Conditions, light: float = 1.0) -> float:
    """Light on a label 300 mm straight ahead; 1 is a normally lit garage.

    Args:
        imaging: Ambient light.
        conditions: The robot's own light.
        light: Ambient light over the configured one.
    """
    return imaging.ambient * light + conditions.lamps.own
