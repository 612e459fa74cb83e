"""The label in one picture, with its outline, its pose and how sure that is."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.schema.inspection import FittedPose, Pixel, PixelEllipse, SeenLabel, Triple
from server.schema.vehicles import Vehicle
from server.vision import LabelPose, Locator, PoseRejectedError, VisionError
from server.vision.markers.code import Code
from server.vision.projection import project, rotation_vector

POINTS_PER_SIDE = 8
"""The lens bends the sides; so many points make them look as bent as they are."""

Array = NDArray[np.float64]
Image = NDArray[np.uint8]
Look = tuple[SeenLabel | None, VisionError | None]


def look_at(locator: Locator, image: Image, vehicles: Sequence[Vehicle]) -> Look:
    """Find a label and fit its pose.

    A pose that fails a gate is shown as its corners say, together with the reason.

    Returns:
        The label, if one could be read, and why there is no pose that deserves trust.

    Raises:
        ValueError: the picture is not two-dimensional uint8.
    """
    try:
        code = locator.read(image)
    except VisionError as error:
        return None, error
    vehicle = next((each for each in vehicles if each.label_payload == code.payload), None)
    if vehicle is None:
        return _without_pose(code, None), None
    size_mm = vehicle.label_size_mm
    try:
        return _with_pose(locator.camera, vehicle, locator.fit(image, code, size_mm)), None
    except VisionError as refusal:
        try:
            coarse = locator.coarse(code, size_mm)
        except PoseRejectedError:
            return _without_pose(code, vehicle.id), refusal
        return _with_pose(locator.camera, vehicle, coarse), refusal


def _without_pose(code: Code, vehicle_id: str | None) -> SeenLabel:
    x, y = code.corners_px.mean(axis=0)
    return SeenLabel(
        payload=code.payload,
        vehicle_id=vehicle_id,
        outline_px=[_pixel(corner) for corner in code.corners_px],
        centre_px=(round(float(x), 2), round(float(y), 2)),
        pose=None,
    )


def _with_pose(camera: CameraModel, vehicle: Vehicle, found: LabelPose) -> SeenLabel:
    T_camera_label = found.T_camera_label
    half_mm = vehicle.label_size_mm / 2
    outline = project(camera, T_camera_label, half_mm * _square()).pixels
    centre = project(camera, T_camera_label, np.zeros((1, 3)))
    axes = project(camera, T_camera_label, half_mm * np.diag([1.0, 1.0, -1.0])).pixels
    return SeenLabel(
        payload=found.payload,
        vehicle_id=vehicle.id,
        outline_px=[_pixel(point) for point in outline],
        centre_px=_pixel(centre.pixels[0]),
        pose=FittedPose(
            source=found.source.value,
            position_mm=_triple(T_camera_label[:3, 3]),
            position_sigma_mm=_triple(found.translation_sigma_mm, 5),
            turn_deg=_triple(np.degrees(rotation_vector(T_camera_label[:3, :3]))),
            turn_sigma_deg=_triple(np.degrees(found.rotation_sigma_rad), 5),
            axes_px=(_pixel(axes[0]), _pixel(axes[1]), _pixel(axes[2])),
            ellipse=ellipse_of(centre.by_pose[0] @ found.covariance @ centre.by_pose[0].T),
            residual_px=round(found.rms_px, 4),
            inlier_share=round(found.inlier_share, 4),
            measurements=found.edge_count,
        ),
    )


def ellipse_of(covariance_px2: Array) -> PixelEllipse:
    """The ellipse of one standard deviation of a covariance, shape (2, 2) [px^2]."""
    variances, directions = np.linalg.eigh(covariance_px2)
    x, y = directions[:, 1]  # eigenvalues ascend
    return PixelEllipse(
        major_px=round(math.sqrt(max(float(variances[1]), 0.0)), 6),
        minor_px=round(math.sqrt(max(float(variances[0]), 0.0)), 6),
        angle_rad=round(math.atan2(float(y), float(x)), 4),
    )


def _square() -> Array:
    """Points along the sides of a square from -1 to 1, shape (n, 2)."""
    corners = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    along = np.linspace(0.0, 1.0, POINTS_PER_SIDE, endpoint=False)[:, None]
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return np.vstack([begin + along * (end - begin) for begin, end in sides])


def _pixel(point: Array) -> Pixel:
    return round(float(point[0]), 2), round(float(point[1]), 2)


def _triple(values: Array, digits: int = 3) -> Triple:
    x, y, z = (round(float(value), digits) for value in values)
    return x, y, z
