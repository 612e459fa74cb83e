"""The blur of a picture, measured by the code that is in it."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.light_field import LightField
from server.vision.fitting.light_picture import LightPicture
from server.vision.fitting.measured_blur import blurred_as_seen
from tests.server.vision.label_shots import MODULES, SIZE_MM
from tests.server.vision.pictures import pose

EDGES = code_edges(MODULES, SIZE_MM)
FINE, QUIET = 4, 3  # samples along a module, modules around the code
SIDE = FINE * (len(MODULES) + 2 * QUIET)
DISTANCE_MM = 240.0
CAMERA = CameraModel(
    width=SIDE, height=SIDE,
    fx=FINE * DISTANCE_MM / EDGES.module_mm, fy=FINE * DISTANCE_MM / EDGES.module_mm,
    cx=(SIDE - 1) / 2, cy=(SIDE - 1) / 2,
)  # fmt: skip
"""Sees every sample in the middle of a pixel of its own."""
EVEN_LIGHT = LightField(
    black=np.array((20.0, 0, 0, 0, 0, 0)), white=np.array((220.0, 0, 0, 0, 0, 0)), half_mm=30.0
)


def diagonal_motion() -> NDArray[np.float32]:
    kernel = np.zeros((7, 7), dtype=np.float32)
    np.fill_diagonal(kernel, (1, 2, 2, 2, 2, 2, 1))
    return np.asarray(kernel / kernel.sum(), dtype=np.float32)


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("hidden", [0, 24], ids=["clear", "covered"])
def test_the_code_is_blurred_as_its_picture_is(*, hidden: int, inverted: bool) -> None:
    """Also where a fifth of it is hidden by something grey, which is no part of the blur."""
    fine = np.pad(~MODULES, QUIET, constant_values=True).repeat(FINE, axis=0).repeat(FINE, axis=1)
    blurred = cv2.filter2D(
        fine.astype(np.float32), -1, diagonal_motion(), borderType=cv2.BORDER_REPLICATE
    )
    seen = (20 + 200 * np.asarray(blurred)).astype(np.float32)
    seen[:hidden] = 110.0
    picture = LightPicture(
        255 - seen if inverted else seen, np.zeros(2, dtype=np.intp), (SIDE - 1) / 2
    )
    place = pose((0.0, 0.0, DISTANCE_MM))
    measured = blurred_as_seen(picture, CAMERA, EDGES, place, EVEN_LIGHT, inverted=inverted)
    inside = (slice(8, -8), slice(8, -8))
    np.testing.assert_allclose(measured.white[inside], blurred[inside], atol=0.04)
