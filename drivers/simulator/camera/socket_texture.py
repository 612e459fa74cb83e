"""What surrounds and makes up the Type 2 inlet of the car, as a texture."""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.textured_plane import PlaneTexture

TEXEL_MM = 0.25
SIDE_MM = 148.0
INLET_DIAMETER_MM = 70.0
_FINE = 4  # texels are drawn this much finer and averaged

_RELIEF = 0.45  # how strongly slopes show in light from above
_EDGE_MM = 0.7  # edges of plastic and sheet metal are rounded
_SHADOW_MM = 5.0

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
_SCREWS = ((-52.0, -52.0), (52.0, -52.0), (-52.0, 52.0), (52.0, 52.0))

Layer = NDArray[np.uint8]


@cache
def socket_texture() -> PlaneTexture:
    """The recess of the charging flap with the inlet in its middle, lit from above.

    A rounded recess behind a gap; a black inlet with the flat top of its kind, its collar and
    insert; seven contact holes; four screws. Depths shade edges and throw a soft shadow.
    """
    size = int(SIDE_MM / TEXEL_MM) * _FINE
    grey, height, alpha = (np.zeros((size, size), dtype=np.uint8) for _ in range(3))
    recess, radius = SIDE_MM / 2 - 4, INLET_DIAMETER_MM / 2
    _rounded_square(alpha, recess, 22.0, 255)
    height.fill(200)
    for layer, gap, floor in ((grey, 10, 58), (height, 60, 110)):
        _rounded_square(layer, recess, 22.0, gap)
        _rounded_square(layer, recess - 2.5, 20.0, floor)
    for x, y in _SCREWS:
        for layer, head, slot in ((grey, 74, 22), (height, 125, 100)):
            _disc(layer, x, y, 4.0, head)
            _disc(layer, x, y, 1.6, slot)
    for layer, flange, collar, well, insert in ((grey, 44, 24, 9, 20), (height, 128, 176, 60, 150)):
        _disc(layer, 0.0, 0.0, radius + 6.0, flange)
        _flat_topped(layer, radius, collar)
        _flat_topped(layer, radius - 3.0, well)
        _flat_topped(layer, radius - 6.5, insert)
        for x, y, diameter in _CONTACTS:
            _disc(layer, x, y, diameter / 2 + 1.8, insert + 10)
            _disc(layer, x, y, diameter / 2, 4)
    for x, y, diameter in _CONTACTS:
        _disc(grey, x, y + 0.4, diameter / 4, 15)  # the metal deep inside
    lit = _shrunk(grey) * _relief(_shrunk(height)) * _shadow(_shrunk(alpha))
    cover = _shrunk(alpha)
    reflectance = np.asarray(np.clip(lit, 0.004, 0.9) * cover, np.float32)
    for shared in (reflectance, cover):
        shared.flags.writeable = False
    return PlaneTexture(reflectance, cover, TEXEL_MM)


def _relief(height: NDArray[np.float32]) -> NDArray[np.float32]:
    """Faces that look up are brighter, those that look down darker; y is down."""
    soft = cv2.GaussianBlur(height, (0, 0), _EDGE_MM / TEXEL_MM)
    slope_y, slope_x = np.gradient(soft, TEXEL_MM)
    return np.asarray(np.clip(1 + 10 * _RELIEF * (slope_y + 0.4 * slope_x), 0.25, 2.6), np.float32)


def _shadow(cover: NDArray[np.float32]) -> NDArray[np.float32]:
    """The edge of the flap's opening shades the recess, most below its upper side."""
    moved = np.roll(cover, round(0.7 * _SHADOW_MM / TEXEL_MM), axis=0)
    soft = cv2.GaussianBlur(moved, (0, 0), _SHADOW_MM / TEXEL_MM)
    return np.asarray(0.3 + 0.7 * soft**1.5, dtype=np.float32)


def _shrunk(layer: Layer) -> NDArray[np.float32]:
    side = layer.shape[0] // _FINE
    small = cv2.resize(layer, (side, side), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.float32) / np.float32(255)


def _place(layer: Layer, x_mm: float, y_mm: float) -> tuple[int, int]:
    scale = _FINE / TEXEL_MM
    middle = (layer.shape[0] - 1) / 2
    return round(middle + x_mm * scale), round(middle + y_mm * scale)


def _disc(layer: Layer, x_mm: float, y_mm: float, radius_mm: float, grey: int) -> None:
    radius = round(radius_mm * _FINE / TEXEL_MM)
    cv2.circle(layer, _place(layer, x_mm, y_mm), radius, (grey,), cv2.FILLED)


def _flat_topped(layer: Layer, radius_mm: float, grey: int) -> None:
    """A disc whose top is cut off at 0.8 of its radius: the shape of a Type 2 inlet."""
    angles = np.linspace(0, 2 * np.pi, 360, endpoint=False)
    x, y = np.cos(angles), np.maximum(np.sin(angles), -0.8)
    points = [_place(layer, radius_mm * u, radius_mm * v) for u, v in zip(x, y, strict=True)]
    cv2.fillPoly(layer, [np.array(points, dtype=np.int32)], (grey,))


def _bar(layer: Layer, first: tuple[float, float], last: tuple[float, float], grey: int) -> None:
    cv2.rectangle(layer, _place(layer, *first), _place(layer, *last), (grey,), cv2.FILLED)


def _rounded_square(layer: Layer, half_mm: float, corner_mm: float, grey: int) -> None:
    inner = half_mm - corner_mm
    _bar(layer, (-half_mm, -inner), (half_mm, inner), grey)
    _bar(layer, (-inner, -half_mm), (inner, half_mm), grey)
    for x in (-inner, inner):
        for y in (-inner, inner):
            _disc(layer, x, y, corner_mm, grey)
