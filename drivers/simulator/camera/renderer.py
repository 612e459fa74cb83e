"""Scene and sensor together: a view becomes a picture."""

from __future__ import annotations

from threading import Lock

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.scene import SceneRenderer
from drivers.simulator.camera.sensor import Sensor
from drivers.simulator.view import CameraView


class Renderer:
    """Renders what a camera with the given true optics would see.

    Pixel centres are at integer coordinates. Edges are prefiltered, so a measured place is off
    by what the measurement does wrong, not by the renderer. Threads wait for one another.
    """

    def __init__(self, optics: CameraModel, imaging: ImagingParameters, seed: int) -> None:
        self._drawing = Lock()
        self._scene = SceneRenderer(optics, imaging)
        self._sensor = Sensor(optics, imaging, self._scene.grid, seed)

    def picture(self, view: CameraView, sequence: int, *, dark: bool = False) -> NDArray[np.uint8]:
        """Render a frame.

        Args:
            view: The true scene in the middle of the exposure.
            sequence: Number of the frame; with the seed it determines the noise.
            dark: No light reaches the sensor.

        Returns:
            Grey values, shape (height, width).
        """
        with self._drawing:  # a picture whose asker was cancelled may still be in the making
            return self._sensor.expose(self._scene.render(view), sequence, dark=dark)
