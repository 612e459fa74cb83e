"""The methods that are compared; each turns a picture into a pose, or None."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import zxingcpp
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision import LabelPose, Locator, VisionError
from server.vision.fitting.start_pose import start_poses
from server.vision.markers.april_tags import AprilTags
from server.vision.projection import Array, perturbed
from tests.bench.vision.scenes import PAYLOAD, TAG, plain_scene

Image = NDArray[np.uint8]
Method = Callable[[Image, float], Array | None]
"""From a picture and the label's size [mm] to T_camera_label."""

QR_CODE = zxingcpp.BarcodeFormats([zxingcpp.BarcodeFormat.QRCodeModel2])
PREDICTION_SIGMA = np.array([0.01, 0.01, 0.005, 0.3, 0.3, 0.8])
"""Of (omega [rad], tau [mm]): what a robot that moved a little knows beforehand."""


class FullLocator:
    """This project's locator, searching the whole picture."""

    def __init__(self, camera: CameraModel, *, tag: bool = False) -> None:
        self._locator = Locator(camera, marker=AprilTags() if tag else None)
        self._payload = TAG if tag else PAYLOAD

    def __call__(self, image: Image, size_mm: float) -> LabelPose | None:
        try:
            return self._locator.locate(
                image, label_size_mm=size_mm, expected_payload=self._payload
            )
        except VisionError:
            return None


class TrackedLocator:
    """This project's locator with a predicted pose that is a little wrong."""

    def __init__(self, camera: CameraModel) -> None:
        self._locator = Locator(camera)
        self._rng = np.random.default_rng(5)
        scene = plain_scene(camera, self._rng, 300.0, 310.0, 60.0)
        self._locator.locate(scene.picture(camera, (5,)), label_size_mm=60.0)

    def predict(self, true: Array) -> Array:
        return perturbed(true, self._rng.normal(0, PREDICTION_SIGMA))

    def __call__(self, image: Image, size_mm: float, predicted: Array) -> LabelPose | None:
        try:
            return self._locator.locate(
                image, label_size_mm=size_mm, expected_payload=PAYLOAD, predicted=predicted
            )
        except VisionError:
            return None


def compared(camera: CameraModel) -> dict[str, Method]:
    """Decoders of QR codes with the pose of their four corners."""

    def posed(corners: Any, size_mm: float, inwards_px: float = 0.0) -> Array | None:  # noqa: ANN401 - OpenCV's and the decoders' many kinds
        points = np.asarray(corners, dtype=np.float64).reshape(4, 2) - inwards_px
        starts = start_poses(camera, points, size_mm)
        return starts[0].T_camera_label if starts else None

    def zxing(image: Image, size_mm: float) -> Array | None:
        for code in zxingcpp.read_barcodes(image, QR_CODE):
            if code.text == PAYLOAD:
                place = code.position
                points = (place.top_left, place.top_right, place.bottom_right, place.bottom_left)
                return posed([(point.x, point.y) for point in points], size_mm, 0.5)
        return None

    def opencv(detector: Any) -> Method:  # noqa: ANN401 - two classes without a common base
        def read(image: Image, size_mm: float) -> Array | None:
            found, texts, corners, _ = detector.detectAndDecodeMulti(image)
            if found:
                for text, quad in zip(texts, corners, strict=True):
                    if text == PAYLOAD:
                        return posed(quad, size_mm)
            return None

        return read

    return {
        "zxing-cpp + corners": zxing,
        "cv2.QRCodeDetector + corners": opencv(cv2.QRCodeDetector()),
        "cv2.QRCodeDetectorAruco + corners": opencv(cv2.QRCodeDetectorAruco()),
    }


def tag_library(camera: CameraModel) -> Method | None:
    """The reference implementation of AprilTag, if pupil-apriltags is installed."""
    try:
        library = importlib.import_module("pupil_apriltags")  # not a requirement of the project
    except ImportError:
        return None
    detector = library.Detector(families="tag36h11", nthreads=1, quad_decimate=1.0)

    def read(image: Image, size_mm: float) -> Array | None:
        for found in detector.detect(image):
            if f"tag36h11:{found.tag_id}" == TAG:
                # Its corners run the other way round, and its tag stands on its head.
                corners = np.roll(found.corners[::-1], 2, axis=0) - 0.5
                starts = start_poses(camera, corners, size_mm)
                return starts[0].T_camera_label if starts else None
        return None

    return read
