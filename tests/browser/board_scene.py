"""What the page is shown while the camera is calibrated: a board held before it, and the result."""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import pi_camera_v2
from server.calibration.camera.board_sight import BoardFinder
from server.calibration.grade import Grade
from server.labels.board_layout import BoardLayout
from server.schema.board import BoardLook, BoardWish
from server.schema.calibrations import (
    CalibrationDetail,
    CalibrationKind,
    CameraEvidence,
    CameraValues,
    CameraViewRecord,
)
from server.schema.routines import RoutineFigure, RoutineQuestion
from server.simulated_board import board_picture

CAMERA = "camera"
"""Id of the version that the board has given."""

ENOUGH = RoutineQuestion(
    code="camera_enough",
    text="End when you like: what there is can be worked out now.",
    input=None,
)
COVERAGE = [
    [0, 2, 9, 12, 12, 8, 3, 0],
    [1, 6, 14, 17, 16, 12, 5, 1],
    [2, 8, 16, 20, 19, 14, 4, 0],
    [2, 7, 15, 19, 18, 11, 0, 0],
    [1, 5, 11, 14, 12, 6, 0, 0],
    [0, 2, 6, 8, 5, 0, 0, 0],
]
FIGURES = [
    RoutineFigure(code="fx", label="Focal length", value=1296.4, sigma=0.42, unit="px"),
    RoutineFigure(code="cx", label="Centre, across", value=818.2, sigma=0.31, unit="px"),
    RoutineFigure(code="cy", label="Centre, down", value=617.9, sigma=0.29, unit="px"),
]


@cache
def _picture() -> NDArray[np.uint8]:
    """The board, tilted, left of the middle."""
    transform = np.eye(4)
    transform[:3, :3] = cv2.Rodrigues(np.array([0.15, 0.45, 0.05]))[0]
    transform[:3, 3] = (-150.0, -105.0, 410.0)
    return board_picture(pi_camera_v2(), BoardLayout(), transform, np.random.default_rng(3))


def picture() -> bytes:
    """As it is sent."""
    return bytes(cv2.imencode(".jpg", _picture())[1])


@cache
def look() -> BoardLook:
    """What was found in it."""
    optics = pi_camera_v2()
    sight = BoardFinder(BoardLayout(), optics).find(_picture(), "scene")
    assert sight.view is not None
    return BoardLook(
        sequence=57,
        width_px=optics.width,
        height_px=optics.height,
        corners_px=[(x, y) for x, y in sight.view.image_px.round(1).tolist()],
        outline_px=sight.outline_px,
        notice="taken",
        wish=BoardWish(place="lower_right", attitude="left_away"),
        taken=11,
        wanted=17,
        coverage=COVERAGE,
    )


def version(other: CalibrationDetail) -> CalibrationDetail:
    """A camera that is good but for one picture; the rest is as of another version."""
    rng = np.random.default_rng(7)
    views = [
        CameraViewRecord(
            rms_px=0.61 if number == 9 else float(rng.uniform(0.09, 0.19)),
            tilt_rad=0.3,
            distance_mm=380.0,
            used=number != 9,
        )
        for number in range(17)
    ]
    evidence = CameraEvidence(
        views=views, coverage=COVERAGE, sigma={"fx": 0.42, "cx": 0.31}, rms_px=0.14, check_px=0.16
    )
    changes = {
        "id": CAMERA,
        "kind": CalibrationKind.CAMERA,
        "version": 1,
        "values": CameraValues(camera=pi_camera_v2()),
        "evidence": None,
        "camera_evidence": evidence,
        "grade": Grade.USABLE,
        "remarks": [
            "The board has been in 75 % of the picture: move it to where it was not, above all to "
            "the right edge."
        ],
        "error": 0.16,
        "error_in_use": 1.83,
        "in_force": False,
    }
    return other.model_copy(update=changes)
