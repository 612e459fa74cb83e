"""From the corners of the board to the camera model (Zhang 2000, as OpenCV solves it)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.calibration.camera.board_views import FEWEST_VIEWS, BoardView, BoardViews
from server.calibration.camera.errors import CalibrationDivergedError

OUTLIER_FACTOR = 3.0
"""A view whose residual is so many times the median of all is left out (moved, bent, wrong)."""

NAMES = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")
"""Order of OpenCV's intrinsics."""


@dataclass(frozen=True, slots=True, eq=False)
class ViewResult:
    """How one picture fits.

    Attributes:
        name: Of the picture.
        rms_px: Root mean square distance of its corners from where the model has them.
        tilt_rad: Angle between the board and the picture plane.
        distance_mm: From the camera to the middle of the corners.
        used: False for an outlier that was left out.
    """

    name: str
    rms_px: float
    tilt_rad: float
    distance_mm: float
    used: bool


@dataclass(frozen=True, slots=True, eq=False)
class CameraSolution:
    """The model and how sure it is.

    Attributes:
        camera: The model.
        sigma: Standard deviation of each of its numbers, from the residuals.
        rms_px: Root mean square residual of all used corners.
        check_px: The same on pictures that were not used to find the model (every fourth in
            turn), so that a model that only follows the noise is noticed.
        views: All pictures with enough corners.
    """

    camera: CameraModel
    sigma: dict[str, float]
    rms_px: float
    check_px: float
    views: tuple[ViewResult, ...]


def solve_camera(found: BoardViews) -> CameraSolution:
    """Fit focal lengths, principal point and five distortion coefficients.

    Raises:
        CalibrationDivergedError: no sensible model explains the pictures.
    """
    used = list(found.views)
    left_out: list[BoardView] = []
    fit = _fit(used, found)
    while True:
        median_px = float(np.median(fit.view_rms_px))
        worst = int(np.argmax(fit.view_rms_px))
        if fit.view_rms_px[worst] <= OUTLIER_FACTOR * median_px or len(used) <= FEWEST_VIEWS:
            break
        left_out.append(used.pop(worst))
        fit = _fit(used, found)
    results = [_result(view, fit.camera, used=True) for view in used]
    results += [_result(view, fit.camera, used=False) for view in left_out]
    order = {view.name: number for number, view in enumerate(found.views)}
    return CameraSolution(
        fit.camera,
        fit.sigma,
        fit.rms_px,
        _cross_check(used, found),
        tuple(sorted(results, key=lambda result: order[result.name])),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Fit:
    camera: CameraModel
    sigma: dict[str, float]
    rms_px: float
    view_rms_px: NDArray[np.float64]


def _fit(views: Sequence[BoardView], found: BoardViews) -> _Fit:
    size = (found.width_px, found.height_px)
    try:
        rms_px, matrix, distortion, _, _, deviations, _, view_rms = cv2.calibrateCameraExtended(
            [_on_plane(view) for view in views],
            [view.image_px.astype(np.float32) for view in views],
            size,
            _first_guess(size),
            np.zeros(5),
            flags=cv2.CALIB_USE_INTRINSIC_GUESS,
        )
    except cv2.error as error:
        raise CalibrationDivergedError(
            f"The pictures lead to no camera: {error.err}.", pictures=len(views)
        ) from error
    numbers = [matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2], *np.ravel(distortion)[:5]]
    if not np.all(np.isfinite(numbers)) or min(numbers[:2]) <= 0:
        raise CalibrationDivergedError("The pictures lead to a camera that cannot exist.")
    values = dict(zip(NAMES, map(float, numbers), strict=True))
    camera = CameraModel(width=size[0], height=size[1], **values)
    sigma = dict(zip(NAMES, map(float, np.ravel(deviations)[: len(NAMES)]), strict=True))
    return _Fit(camera, sigma, float(rms_px), np.ravel(view_rms))


def _first_guess(size: tuple[int, int]) -> NDArray[np.float64]:
    """Sixty degrees of view and a centred lens: near enough for any camera of this kind."""
    focal_px = 0.5 * size[0] / math.tan(math.radians(30.0))
    return np.array(
        [
            [focal_px, 0.0, 0.5 * (size[0] - 1)],
            [0.0, focal_px, 0.5 * (size[1] - 1)],
            [0.0, 0.0, 1.0],
        ]
    )


def _on_plane(view: BoardView) -> NDArray[np.float32]:
    return np.column_stack((view.board_mm, np.zeros(len(view.board_mm)))).astype(np.float32)


def _result(view: BoardView, camera: CameraModel, *, used: bool) -> ViewResult:
    rotation, translation, rms_px = _place(view, camera)
    normal = cv2.Rodrigues(rotation)[0][:, 2]
    middle = np.append(view.board_mm.mean(axis=0), 0.0)
    centre = cv2.Rodrigues(rotation)[0] @ middle + np.ravel(translation)
    tilt_rad = math.acos(min(1.0, abs(float(normal[2]))))
    return ViewResult(view.name, rms_px, tilt_rad, float(np.linalg.norm(centre)), used)


def _place(
    view: BoardView, camera: CameraModel
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Where the board is in one picture, and how well that fits."""
    plane = _on_plane(view).astype(np.float64)
    found, rotation, translation = cv2.solvePnP(
        plane, view.image_px, camera.matrix, camera.distortion
    )
    if not found:
        raise CalibrationDivergedError(f"{view.name} does not fit to the others at all.")
    seen, _ = cv2.projectPoints(plane, rotation, translation, camera.matrix, camera.distortion)
    offsets = seen.reshape(-1, 2) - view.image_px
    rms_px = math.sqrt(float(np.mean(np.sum(offsets**2, axis=1))))
    return np.asarray(rotation), np.asarray(translation), rms_px


def _cross_check(views: Sequence[BoardView], found: BoardViews, parts: int = 4) -> float:
    """Residual of each quarter of the pictures under the model of the other three."""
    squares, corners = 0.0, 0
    for part in range(parts):
        held = views[part::parts]
        rest = [view for number, view in enumerate(views) if number % parts != part]
        camera = _fit(rest, found).camera
        for view in held:
            squares += _place(view, camera)[2] ** 2 * len(view.board_mm)
            corners += len(view.board_mm)
    return math.sqrt(squares / corners)
