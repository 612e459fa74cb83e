"""Locating a label: this project's locator beside decoders with a four-corner pose.

Run as ``python -m tests.bench.locate [--pictures N]``. All methods see the same rendered pictures
(1640 x 1232, default optics, known poses), one thread each. Printed per range of distance: share
of pictures located, and median/95th percentile of the lateral, depth and tilt error and of the
time. A second table tells how far the mean of ten pictures of a standstill stays off.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import NamedTuple

import cv2
import numpy as np
import zxingcpp
from numpy.typing import NDArray

from server.vision import Locator, VisionError, combine
from server.vision.projection import Array
from server.vision.start_pose import start_poses
from tests.server.vision.pictures import (
    OPTICS,
    PAYLOAD,
    SIZE_MM,
    picture,
    pose_error,
    random_pose,
    view,
)

Image = NDArray[np.uint8]
Method = Callable[[Image], Array | None]
QR_CODE = zxingcpp.BarcodeFormats([zxingcpp.BarcodeFormat.QRCodeModel2])
RANGES_MM = ((110.0, 160.0), (160.0, 300.0), (300.0, 450.0), (450.0, 600.0))


class Score(NamedTuple):
    """One located picture: lateral [mm], depth [mm], tilt [deg], time [ms]."""

    lateral_mm: float
    depth_mm: float
    tilt_deg: float
    time_ms: float


def with_opencv(image: Image) -> Array | None:
    """cv2.QRCodeDetector and the four-corner pose; its corners are already pixel centres."""
    text, corners, _ = cv2.QRCodeDetector().detectAndDecode(image)
    if text != PAYLOAD:
        return None
    return _from_corners(np.asarray(corners, dtype=np.float64).reshape(4, 2))


def with_zxing(image: Image) -> Array | None:
    """zxing-cpp as it comes and the four-corner pose."""
    for code in zxingcpp.read_barcodes(image, QR_CODE):
        if code.text == PAYLOAD:
            place = code.position
            points = (place.top_left, place.top_right, place.bottom_right, place.bottom_left)
            return _from_corners(np.array([(point.x - 0.5, point.y - 0.5) for point in points]))
    return None


def _from_corners(corners_px: Array) -> Array | None:
    starts = start_poses(OPTICS, corners_px, SIZE_MM)
    return starts[0].T_camera_label if starts else None


def with_locator(image: Image) -> Array | None:
    """This project's locator, decoding anew."""
    try:
        return LOCATOR.locate(image, label_size_mm=SIZE_MM).T_camera_label
    except VisionError:
        return None


LOCATOR = Locator(OPTICS)
METHODS: dict[str, Method] = {
    "cv2.QRCodeDetector + corners": with_opencv,
    "zxing-cpp + corners": with_zxing,
    "Locator (all edges)": with_locator,
}


def compare(pictures: int) -> None:
    """Print the table of all methods over all ranges."""
    print(f"{'method':30} {'mm':>9} {'found':>7} {'lateral mm':>15} {'depth mm':>15}", end="")
    print(f" {'tilt deg':>15} {'ms':>13}")
    for nearest, farthest in RANGES_MM:
        rng = np.random.default_rng(int(nearest))
        scores: dict[str, list[Score]] = {name: [] for name in METHODS}
        for number in range(pictures):
            true = random_pose(rng, nearest, farthest)
            image = picture(view(true), number)
            for name, method in METHODS.items():
                started = time.perf_counter()
                found = method(image)
                elapsed_ms = 1000 * (time.perf_counter() - started)
                if found is not None:
                    scores[name].append(_score(found, true, elapsed_ms))
        for name, rows in scores.items():
            _print_row(name, f"{nearest:.0f}-{farthest:.0f}", rows, pictures)


def _score(found: Array, true: Array, elapsed_ms: float) -> Score:
    error = pose_error(found, true)
    tilt_deg = float(np.degrees(np.hypot(error[0], error[1])))
    return Score(float(np.hypot(error[3], error[4])), abs(float(error[5])), tilt_deg, elapsed_ms)


def _print_row(name: str, distance: str, rows: list[Score], pictures: int) -> None:
    print(f"{name:30} {distance:>9} {len(rows):>3}/{pictures:<3}", end="")
    digits = Score(4, 4, 3, 1)
    for values, places in zip(zip(*rows, strict=True), digits, strict=False):
        middle, high = np.percentile(values, (50, 95))
        print(f" {middle:>7.{places}f}/{high:<7.{places}f}", end="")
    print()


def standstill(places: int, pictures: int = 10) -> None:
    """Print how far the mean of several pictures of the same scene stays off, and says so."""
    rng = np.random.default_rng(17)
    errors, promised = [], []
    for place in range(places):
        true = random_pose(rng, 270.0, 310.0)
        poses = [
            LOCATOR.locate(picture(view(true), place * pictures + n), label_size_mm=SIZE_MM)
            for n in range(pictures)
        ]
        mean = combine(poses)
        errors.append(np.abs(pose_error(mean.T_camera_label, true)))
        promised.append(np.sqrt(np.diag(mean.covariance)))
    print(f"\nmean of {pictures} pictures at 270-310 mm, {places} places: rms error (promised)")
    names = ("about x rad", "about y rad", "about z rad", "x mm", "y mm", "z mm")
    rms = np.sqrt(np.mean(np.square(errors), axis=0))
    for name, error, sigma in zip(names, rms, np.mean(promised, axis=0), strict=True):
        print(f"  {name:12} {error:.6f} ({sigma:.6f})")


def main() -> None:
    """Read the arguments and print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--pictures", type=int, default=40, help="per range of distance")
    pictures = parser.parse_args().pictures
    cv2.setNumThreads(1)
    compare(pictures)
    standstill(max(pictures // 3, 2))


if __name__ == "__main__":
    main()
