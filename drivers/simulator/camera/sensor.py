"""From light to grey values: drops on the glass, noise, gain, gamma."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.auto_exposure import ExposureSetting
from drivers.simulator.camera.coarse_grid import CoarseGrid, Field
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.scene import Exposed

_ROWS_AT_ONCE = 32
_LEVELS = 4096
_NOISE_POOL = 1 << 20
_NOMINAL_EXPOSURE_S = 0.008
_VEIL_STRIDE_PX = 16


class Sensor:
    """Exposes canvases to grey pictures. Not for use by several threads at once.

    Args:
        optics: Size of the picture.
        imaging: Noise and gamma.
        grid: Nodes at which light is given.
        cover: Share of the aperture behind drops on the glass at the nodes; None without drops.
        seed: Of the noise.
    """

    def __init__(
        self,
        optics: CameraModel,
        imaging: ImagingParameters,
        grid: CoarseGrid,
        cover: Field | None,
        seed: int,
    ) -> None:
        self._imaging = imaging
        self._grid = grid
        self._seed = seed
        self._shape = (optics.height, optics.width)
        self._cover = None if cover is None else grid.enlarged(cover)
        # Drawing two million normal numbers per picture would cost more than all the rest:
        # strips take random pieces of one pool instead.
        generator = np.random.default_rng(seed)
        self._noise = generator.standard_normal(_NOISE_POOL, dtype=np.float32)
        levels = np.linspace(0, 1, _LEVELS) ** (1 / imaging.gamma)
        self._grey_of_level = np.round(255 * levels).astype(np.uint8)
        self._light: tuple[Field, float, Field] | None = None

    def expose(
        self, exposed: Exposed, sequence: int, setting: ExposureSetting
    ) -> NDArray[np.uint8]:
        """Take a picture.

        Args:
            exposed: What reaches the lens.
            sequence: Number of the frame; together with the seed it determines the noise.
            setting: Exposure time and gain.

        Returns:
            Grey values, shape (height, width).
        """
        imaging = self._imaging
        generator = np.random.default_rng((self._seed, sequence))
        exposure = imaging.exposed_white / imaging.white_reflectance
        exposure *= setting.exposure_s / _NOMINAL_EXPOSURE_S
        # All in levels behind the gain. Full wells need no limit of their own: the gain is never
        # below 1, so they are white.
        levels = setting.gain * (_LEVELS - 1)
        light = self._everywhere(exposed.light, exposure * levels)
        shot = np.float32(levels / imaging.full_well_electrons)
        read = np.float32(
            (levels * imaging.read_noise_electrons / imaging.full_well_electrons) ** 2
        )
        veil = np.float32(self._veil(exposed) * exposure * levels)
        image = np.empty(self._shape, dtype=np.uint8)
        rows, columns = self._shape
        for top in range(0, rows, _ROWS_AT_ONCE):
            strip = np.s_[top : min(top + _ROWS_AT_ONCE, rows)]
            signal = exposed.canvas[strip] * light[strip]
            if self._cover is not None:
                signal += self._cover[strip] * (veil - signal)
            start = int(generator.integers(_NOISE_POOL - _ROWS_AT_ONCE * columns))
            noise = self._noise[start : start + signal.size].reshape(signal.shape)
            deviation = signal * shot
            deviation += read
            np.sqrt(deviation, out=deviation)
            deviation *= noise
            whole = np.asarray(cv2.add(signal, deviation, dtype=cv2.CV_16U), np.uint16)  # none < 0
            np.take(self._grey_of_level, whole, out=image[strip], mode="clip")
        return image

    def _everywhere(self, light: Field, scale: float) -> Field:
        """Scaled light at all pixels; mostly it stays the same."""
        if self._light is None or self._light[0] is not light or self._light[1] != scale:
            self._light = (light, scale, self._grid.enlarged(light * np.float32(scale)))
        return self._light[2]

    def _veil(self, exposed: Exposed) -> float:
        """Light through a drop comes from all over the scene."""
        if self._cover is None:
            return 0.0
        coarse = exposed.canvas[::_VEIL_STRIDE_PX, ::_VEIL_STRIDE_PX]
        return float(coarse.mean()) * float(exposed.light.mean())
