"""What the code should look like through the blur of its own picture.

Where motion or defocus reach as far as the next module, the light of neighbours flows into the
profile of every edge and shifts its centroid, each in its own way, because neighbours differ. The
modules are known, and so the blur can be measured (least squares over the whole code), and the
neighbours' part be computed and taken away.
"""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.blurred_code import BlurredCode
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.light_field import LightField
from server.vision.fitting.light_picture import LightPicture
from server.vision.fitting.median import median
from server.vision.projection import Array, project

_SAMPLES = 4  # along a module
_QUIET_MODULES = 3
_REACH_SAMPLES = 5  # of the kernel: one and a quarter modules
_MOST_EQUATIONS = 4000
_RIDGE = 1e-4
_TUKEY = 4.685
_REWEIGHTINGS = 2

Samples = NDArray[np.float32]


def blurred_as_seen(
    picture: LightPicture,
    camera: CameraModel,
    edges: CodeEdges,
    T_camera_label: Array,
    light: LightField,
    *,
    inverted: bool = False,
    row_way: Array | None = None,
) -> BlurredCode:
    """Measure the blur in a picture, and blur the code alike.

    The kernel is any that is symmetric to a point, so the pose is that of the middle of the
    exposure: lens, defocus, straight motion, sharpening.

    Args:
        picture: The light around the label.
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        T_camera_label: Pose within some hundredths of a module, shape (4, 4) [mm].
        light: Black and white across the label.
        inverted: The code is white on black.
        row_way: Way of the label per row, as of ``edge_offsets``.
    """
    white = np.float32(1) - _blackness(edges)
    side = len(white)
    per_mm = _SAMPLES / edges.module_mm
    middle = (side - 1) / 2
    places = (np.arange(side) - middle) / per_mm
    x, y = np.meshgrid(places, places)
    points = np.column_stack((x.ravel(), y.ravel()))
    pixels = project(camera, T_camera_label, points).pixels
    if row_way is not None:
        pixels += (pixels[:, 1:] - picture.middle_row) * row_way
    pixels -= picture.left_top_px
    map_x, map_y = pixels.T.astype(np.float32).reshape(2, side, side)
    seen = cv2.remap(picture.light, map_x, map_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    if inverted:
        seen = 255 - seen
    black, contrast = light.at(points)
    levelled = (seen - black.reshape(side, side)) / contrast.reshape(side, side)
    kernel, background = _kernel(white, np.asarray(levelled, dtype=np.float32))
    blurred = cv2.filter2D(white, -1, kernel, borderType=cv2.BORDER_REPLICATE) + background
    return BlurredCode(np.asarray(blurred, dtype=np.float32), middle, per_mm)


def _blackness(edges: CodeEdges) -> Samples:
    """The code with some of its quiet zone, 1 is black, shape (m, m)."""
    return _sampled(np.packbits(edges.modules).tobytes(), edges.modules.shape[0])


@lru_cache(maxsize=8)
def _sampled(packed: bytes, count: int) -> Samples:
    bits = np.unpackbits(np.frombuffer(packed, dtype=np.uint8), count=count * count)
    framed = np.pad(bits.reshape(count, count), _QUIET_MODULES)
    return framed.repeat(_SAMPLES, axis=0).repeat(_SAMPLES, axis=1).astype(np.float32)


def _kernel(white: Samples, seen: Samples) -> tuple[Samples, float]:
    """The kernel, shape (2 r + 1, 2 r + 1), and the constant that turn the code into the seen."""
    reach = _REACH_SAMPLES
    rows, wanted = _equations(white, seen)
    weights = np.ones_like(wanted)
    for _ in range(_REWEIGHTINGS):
        weighted = rows * weights[:, None]
        normal = weighted.T @ rows
        normal[np.diag_indices_from(normal)] += _RIDGE * np.trace(normal) / len(normal)
        solution = np.linalg.solve(normal, weighted.T @ wanted)
        misses = np.abs(wanted - rows @ solution)
        scale = 1.4826 * median(misses) + 1e-6
        weights = (np.clip(1 - (misses / (_TUKEY * scale)) ** 2, 0, 1) ** 2).astype(np.float32)
    kernel = np.zeros((2 * reach + 1, 2 * reach + 1), dtype=np.float32)
    for (down, right), value in zip(_half_plane(reach), solution, strict=False):
        kernel[reach + down, reach + right] = kernel[reach - down, reach - right] = value
    return kernel, float(solution[-1])


def _equations(white: Samples, seen: Samples) -> tuple[Samples, Samples]:
    """Left and right sides of seen = kernel * white + constant at evenly spread samples."""
    reach, side = _REACH_SAMPLES, len(white)
    inner = side - 2 * reach
    chosen = np.linspace(0, inner**2 - 1, min(inner**2, _MOST_EQUATIONS)).round().astype(np.intp)
    place = (chosen // inner + reach) * side + chosen % inner + reach
    flat = white.ravel()
    columns = []
    for down, right in _half_plane(reach):
        shift = down * side + right
        column = flat[place + shift]
        columns.append(column + flat[place - shift] if shift else column)
    columns.append(np.ones_like(columns[0]))
    return np.stack(columns, axis=1), seen.ravel()[place]


def _half_plane(reach: int) -> list[tuple[int, int]]:
    """One of each two opposite offsets (down, right), and the middle."""
    offsets = range(-reach, reach + 1)
    return [(down, right) for down in offsets for right in offsets if (down, right) >= (0, 0)]
