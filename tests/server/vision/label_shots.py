"""Shots of real-looking labels for the tests: one camera, one place, whatever is printed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.projection import Array
from tests.server.vision.pictures import PAYLOAD, pose
from tests.support.label_pictures import Placed, photograph
from tests.support.label_prints import Print, printed
from tests.support.picture_taking import Shot
from twin.qr_label import label_modules

CAMERA = CameraModel(
    width=640, height=480, fx=700.0, fy=700.0, cx=322.3, cy=237.1, k1=-0.03, k2=0.02, p1=1e-4
)
SIZE_MM = 60.0
PLACE = pose((6.0, -4.0, 230.0), (4.0, -5.0, 8.0))
MODULES = label_modules(PAYLOAD)
LABEL = printed(MODULES, SIZE_MM, ink_modules=0.04)


def shot_of(
    label: Print = LABEL,
    T_camera_label: Array = PLACE,
    *,
    shot: Shot | None = None,
    lift_mm: float = 0.0,
    bow_mm: float = 0.0,
    others: Sequence[Placed] = (),
    seed: int = 1,
) -> NDArray[np.uint8]:
    """A picture of a label, by default our own in the middle of a well lit picture."""
    placed = (*others, Placed(label, T_camera_label, lift_mm, bow_mm=bow_mm))
    return photograph(CAMERA, placed, shot or Shot(), np.random.default_rng(seed))
