"""From light to grey values: illumination, automatic gain, noise, gamma."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.ray_grid import RayGrid
from drivers.simulator.camera.textured_plane import Canvas

_COARSE_PX = 16
_ROWS_AT_ONCE = 32
_LEVELS = 4096
_NOISE_POOL = 1 << 20


class Sensor:
    """Exposes canvases to grey pictures. Not for use by several threads at once."""

    def __init__(
        self, optics: CameraModel, imaging: ImagingParameters, grid: RayGrid, seed: int
    ) -> None:
        self._imaging = imaging
        self._seed = seed
        self._shape = (optics.height, optics.width)
        self._light = _light(imaging, grid.coarse(_COARSE_PX), optics)
        # Drawing two million normal numbers per picture would cost more than all the rest:
        # strips take random pieces of one pool instead.
        generator = np.random.default_rng(seed)
        self._noise = generator.standard_normal(_NOISE_POOL, dtype=np.float32)
        levels = np.linspace(0, 1, _LEVELS) ** (1 / imaging.gamma)
        self._grey_of_level = np.round(255 * levels).astype(np.uint8)

    def expose(self, canvas: Canvas, sequence: int, *, dark: bool = False) -> NDArray[np.uint8]:
        """Take the picture of a canvas.

        Args:
            canvas: Reflectance of every pixel, shape (height, width).
            sequence: Number of the frame; together with the seed it determines the noise.
            dark: Nothing of the light reaches the sensor.

        Returns:
            Grey values, shape (height, width).
        """
        imaging = self._imaging
        generator = np.random.default_rng((self._seed, sequence))
        exposure = imaging.exposed_white / imaging.white_reflectance * imaging.exposure_s / 0.008
        exposure *= 0.0 if dark else imaging.ambient
        gain = self._gain(canvas, exposure)
        image = np.empty(self._shape, dtype=np.uint8)
        shot = 1 / imaging.full_well_electrons
        read = (imaging.read_noise_electrons / imaging.full_well_electrons) ** 2
        for top in range(0, self._shape[0], _ROWS_AT_ONCE):
            bottom = min(top + _ROWS_AT_ONCE, self._shape[0])
            signal = canvas[top:bottom] * self._light_strip(top, bottom)
            signal *= np.float32(exposure)
            start = int(generator.integers(_NOISE_POOL - signal.size))
            noise = self._noise[start : start + signal.size].reshape(signal.shape)
            deviation = np.sqrt(signal * np.float32(shot) + np.float32(read))
            deviation *= noise
            signal += deviation
            signal *= np.float32(gain * (_LEVELS - 1))
            np.clip(signal, 0, _LEVELS - 1, out=signal)
            np.take(self._grey_of_level, signal.astype(np.intp), out=image[top:bottom])
        return image

    def _gain(self, canvas: Canvas, exposure: float) -> float:
        """Gain that brings the bright parts to the target, within the sensor's limits."""
        coarse = canvas[::_COARSE_PX, ::_COARSE_PX]
        light = self._light[: coarse.shape[0], : coarse.shape[1]]
        bright = float(np.percentile(coarse * light, 98)) * exposure
        wanted = self._imaging.target_white / max(bright, 1e-9)
        return float(np.clip(wanted, 1.0, self._imaging.most_gain))

    def _light_strip(self, top: int, bottom: int) -> NDArray[np.float32]:
        to_coarse = np.array([[1 / _COARSE_PX, 0.0, 0.0], [0.0, 1 / _COARSE_PX, top / _COARSE_PX]])
        strip = cv2.warpAffine(
            self._light,
            to_coarse,
            (self._shape[1], bottom - top),
            flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
            borderMode=cv2.BORDER_REPLICATE,
        )
        return np.asarray(strip, dtype=np.float32)


def _light(
    imaging: ImagingParameters, rays: NDArray[np.float32], optics: CameraModel
) -> NDArray[np.float32]:
    """Fall-off of the lens and slope of the lamp's light at coarse pixels, about 1 in the middle.

    The natural fall-off is cos^4 of the angle to the axis, (1 + r^2)^-2.
    """
    natural = (1 + np.sum(rays**2, axis=-1)) ** -2
    falloff = 1 - imaging.vignetting * (1 - natural)
    across = rays[..., 0] * (optics.fx / optics.width)  # -0.5 to 0.5
    return np.asarray(falloff * (1 + imaging.illumination_gradient * across), dtype=np.float32)
