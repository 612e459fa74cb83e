"""What the code should look like through the blur of its own picture.

Where motion or defocus reach as far as the next module, the light of neighbours flows into the
profile of every edge and shifts its centroid, each in its own way, because neighbours differ. The
modules are known, and so the blur can be measured (least squares over the whole code), and the
neighbours' part be computed and taken away.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

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
_REWEIGHTINGS = 4

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
    known = _known(np.packbits(edges.modules).tobytes(), edges.modules.shape[0])
    points = known.places * edges.module_mm
    u_v = project(camera, T_camera_label, points).u_v
    if row_way is not None:
        u_v += (u_v[1] - picture.middle_row) * row_way[:, None]
    map_x, map_y = (u_v - picture.left_top_px[:, None]).astype(np.float32)
    seen = cv2.remap(picture.light, map_x, map_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    grey = np.asarray(seen, dtype=np.float64).ravel()
    if inverted:
        grey = 255 - grey
    black, contrast = light.at(points)
    kernel, background = _kernel(known, ((grey - black) / contrast).astype(np.float32))
    blurred = cv2.filter2D(known.white, -1, kernel, borderType=cv2.BORDER_REPLICATE) + background
    middle = (len(known.white) - 1) / 2
    return BlurredCode(np.asarray(blurred, dtype=np.float32), middle, _SAMPLES / edges.module_mm)


class _Known(NamedTuple):
    """What follows from the code alone; a camera sees one label again and again.

    Attributes:
        white: The code with some of its quiet zone, 0 is black, shape (m, m).
        places: Where the picture is looked at, in modules from the code's middle, shape (n, 2).
        rows: What each unknown adds there, shape (k, n): seen = kernel * white + constant.
        inverse: Of the normal matrix with its ridge, shape (k, k).
        ridge: What was added to its diagonal.
    """

    white: Samples
    places: Array
    rows: Samples
    inverse: Array
    ridge: float


@lru_cache(maxsize=4)
def _known(packed: bytes, count: int) -> _Known:
    bits = np.unpackbits(np.frombuffer(packed, dtype=np.uint8), count=count * count)
    framed = np.pad(bits.reshape(count, count), _QUIET_MODULES)
    white = 1 - framed.repeat(_SAMPLES, axis=0).repeat(_SAMPLES, axis=1).astype(np.float32)
    side, reach = len(white), _REACH_SAMPLES
    inner = side - 2 * reach
    chosen = np.linspace(0, inner**2 - 1, min(inner**2, _MOST_EQUATIONS)).round().astype(np.intp)
    row, column = chosen // inner + reach, chosen % inner + reach
    rows = []
    for down, right in _half_plane(reach):
        there = white[row + down, column + right]
        opposite = white[row - down, column - right]
        rows.append(there + opposite if (down, right) != (0, 0) else there)
    rows.append(np.ones_like(rows[0]))
    exact = np.stack(rows).astype(np.float64)
    normal = exact @ exact.T
    ridge = _RIDGE * float(np.trace(normal)) / len(normal)
    return _Known(
        white=white,
        places=(np.column_stack((column, row)) - (side - 1) / 2) / _SAMPLES,
        rows=exact.astype(np.float32),
        inverse=np.asarray(np.linalg.inv(normal + ridge * np.eye(len(normal))), dtype=np.float64),
        ridge=ridge,
    )


def _kernel(known: _Known, seen: Samples) -> tuple[Samples, float]:
    """The kernel, shape (2 r + 1, 2 r + 1), and the constant that turn the code into the seen.

    Tukey's weights are never larger than 1, so steps with the matrix of all equations alike go
    towards the weighted solution, if a little slowly (Huber 1981, 7.8), and the matrix is the
    code's own.
    """
    reach = _REACH_SAMPLES
    solution = known.inverse @ (known.rows @ seen)
    for _ in range(_REWEIGHTINGS):
        misses = seen - solution.astype(np.float32) @ known.rows
        scale = 1.4826 * median(np.abs(misses)) + 1e-6
        weights = np.maximum(1 - (misses / np.float32(_TUKEY * scale)) ** 2, 0) ** 2
        solution += known.inverse @ (known.rows @ (weights * misses) - known.ridge * solution)
    kernel = np.zeros((2 * reach + 1, 2 * reach + 1), dtype=np.float32)
    for (down, right), value in zip(_half_plane(reach), solution, strict=False):
        kernel[reach + down, reach + right] = kernel[reach - down, reach - right] = value
    return kernel, float(solution[-1])


def _half_plane(reach: int) -> list[tuple[int, int]]:
    """One of each two opposite offsets (down, right), and the middle."""
    offsets = range(-reach, reach + 1)
    return [(down, right) for down in offsets for right in offsets if (down, right) >= (0, 0)]
