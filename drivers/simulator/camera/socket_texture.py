"""What surrounds and makes up the Type 2 inlet of the car, as a texture."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.textured_plane import PlaneTexture

TEXEL_MM = 0.25
SIDE_MM = 148.0
INLET_DIAMETER_MM = 70.0
_FINE = 4  # texels are drawn this much finer and averaged

# Centres [mm, x right, y down] and diameters [mm] after IEC 62196-2, type 2: protective earth in
# the middle, neutral and three phases around it, the two thin pilot contacts on top.
_CONTACTS = (
    (0.0, 0.0, 9.0),
    (-16.0, 0.0, 9.0),
    (16.0, 0.0, 9.0),
    (-8.0, 14.0, 9.0),
    (8.0, 14.0, 9.0),
    (-8.5, -13.0, 6.0),
    (8.5, -13.0, 6.0),
)


def socket_texture() -> PlaneTexture:
    """The recess of the charging flap with the inlet in its middle.

    A rounded recess, darker than the body, with a shadowed rim; a black inlet with the flat top
    of its kind; seven contact holes.
    """
    size = int(SIDE_MM / TEXEL_MM) * _FINE
    reflectance = np.zeros((size, size), dtype=np.uint8)
    alpha = np.zeros_like(reflectance)
    recess = SIDE_MM / 2 - 4
    _rounded_square(alpha, recess, 22.0, 255)
    _rounded_square(reflectance, recess, 22.0, 22)  # shadow in the gap of the flap
    _rounded_square(reflectance, recess - 2.5, 20.0, 62)
    radius = INLET_DIAMETER_MM / 2
    _disc(reflectance, 0.0, 0.0, radius + 3.0, 40)
    _disc(reflectance, 0.0, 0.0, radius, 12)
    _bar(reflectance, (-radius, -radius - 4.0), (radius, -radius + 4.0), 62)  # the flat top
    _disc(reflectance, 0.0, 0.0, radius - 6.0, 26)
    _bar(reflectance, (-22.0, -radius + 4.0), (22.0, -radius + 8.0), 12)
    for x, y, diameter in _CONTACTS:
        _disc(reflectance, x, y, diameter / 2 + 1.5, 34)
        _disc(reflectance, x, y, diameter / 2, 4)
    return PlaneTexture(_shrunk(reflectance), _shrunk(alpha), TEXEL_MM)


def _shrunk(layer: NDArray[np.uint8]) -> NDArray[np.float32]:
    side = layer.shape[0] // _FINE
    small = cv2.resize(layer, (side, side), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.float32) / np.float32(255)


def _place(layer: NDArray[np.uint8], x_mm: float, y_mm: float) -> tuple[int, int]:
    scale = _FINE / TEXEL_MM
    middle = (layer.shape[0] - 1) / 2
    return round(middle + x_mm * scale), round(middle + y_mm * scale)


def _disc(layer: NDArray[np.uint8], x_mm: float, y_mm: float, radius_mm: float, grey: int) -> None:
    radius = round(radius_mm * _FINE / TEXEL_MM)
    cv2.circle(layer, _place(layer, x_mm, y_mm), radius, (grey,), cv2.FILLED)


def _bar(
    layer: NDArray[np.uint8], first: tuple[float, float], last: tuple[float, float], grey: int
) -> None:
    cv2.rectangle(layer, _place(layer, *first), _place(layer, *last), (grey,), cv2.FILLED)


def _rounded_square(layer: NDArray[np.uint8], half_mm: float, corner_mm: float, grey: int) -> None:
    inner = half_mm - corner_mm
    _bar(layer, (-half_mm, -inner), (half_mm, inner), grey)
    _bar(layer, (-inner, -half_mm), (inner, half_mm), grey)
    for x in (-inner, inner):
        for y in (-inner, inner):
            _disc(layer, x, y, corner_mm, grey)
