"""`plugpilot locate`: find the label in pictures and say where it is."""

from __future__ import annotations

import json as json_format
import sys
import time
from pathlib import Path
from typing import Any

import click

from server.vision.camera_file import load_camera_file
from server.vision.errors import PoseRejectedError, VisionError
from server.vision.image_file import load_grey_image
from server.vision.label_pose import LabelPose
from server.vision.locator import Locator
from server.vision.markers.april_tags import AprilTags
from server.vision.markers.qr_codes import QrCodes

RESOLUTION_MISMATCH = "resolution_mismatch"
CORNERS_ONLY = "corners_only"


@click.command()
@click.argument(
    "images", metavar="IMAGE...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@click.option(
    "--camera",
    "camera_file",
    metavar="FILE",
    required=True,
    type=click.Path(path_type=Path),
    help="TOML file with width, height, fx, fy, cx, cy [px] and k1, k2, p1, p2, k3.",
)
@click.option(
    "--label-size-mm",
    required=True,
    type=click.FloatRange(min=0, min_open=True),
    help="Measured outer side of the code without its white margin.",
)
@click.option("--payload", default=None, help="Accept only the code with this text.")
@click.option(
    "--marker",
    type=click.Choice(["qr", "apriltag"]),
    default="qr",
    show_default=True,
    help="Kind of label: a QR code, or an AprilTag of the family 36h11.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object per picture.")
def locate(
    images: tuple[Path, ...],
    camera_file: Path,
    label_size_mm: float,
    payload: str | None,
    marker: str,
    *,
    as_json: bool,
) -> None:
    """Find the socket's label in pictures.

    Prints the pose of the label in the camera frame (x right, y down, z forward, mm) with the
    6 x 6 covariance of (rotation [rad], translation [mm]): a small rotation about the label's
    centre and a shift, both along the axes of the camera. A picture of another resolution than
    the camera file's is located in the camera's pixel coordinates, with a warning; a code whose
    edges do not fit (bent, damaged) from its corners only, with a warning.

    Exit status: 0 if every picture was located, 1 if one or more were not, 2 for wrong usage.
    """
    kind = AprilTags() if marker == "apriltag" else QrCodes()
    locator = Locator(load_camera_file(camera_file), marker=kind)
    failed = False
    for path in images:
        result = _locate_file(locator, path, label_size_mm, payload)
        failed = failed or result["error"] is not None
        click.echo(json_format.dumps(result) if as_json else _line(result))
    if failed:
        sys.exit(1)


def _locate_file(
    locator: Locator, path: Path, label_size_mm: float, payload: str | None
) -> dict[str, Any]:
    """The JSON object of one picture."""
    result: dict[str, Any] = {
        "file": str(path),
        "payload": None,
        "T_camera_label": None,
        "covariance": None,
        "rms_px": None,
        "ms": None,
        "warning": None,
        "error": None,
    }
    try:
        image = load_grey_image(path)
        started = time.perf_counter()
        code = locator.read(image, payload)
        result["payload"] = code.payload
        warnings = []
        try:
            pose = locator.fit(image, code, label_size_mm)
        except PoseRejectedError as rejection:
            pose = locator.coarse(code, label_size_mm)
            warnings.append((CORNERS_ONLY, f"{rejection.detail} Only its corners were used."))
        result["ms"] = round(1000 * (time.perf_counter() - started), 3)
        result |= _pose_fields(pose)
        camera = locator.camera
        if image.shape != (camera.height, camera.width):
            size = f"{image.shape[1]} x {image.shape[0]} px"
            detail = (
                f"The picture is {size}, the camera file is for {camera.width} x {camera.height} "
                "px: the pose is right only if the picture is the top left part of the camera's."
            )
            warnings.insert(0, (RESOLUTION_MISMATCH, detail))
        if warnings:  # the code of the graver one, the words of all
            result["warning"] = _note(warnings[0][0], " ".join(text for _, text in warnings))
    except VisionError as error:
        result["error"] = _note(error.code, error.detail)
    return result


def _note(code: str, message: str) -> dict[str, str]:
    return {"code": code, "message": message}


def _pose_fields(pose: LabelPose) -> dict[str, Any]:
    return {
        "T_camera_label": {
            "rotation": pose.T_camera_label[:3, :3].tolist(),
            "translation_mm": pose.T_camera_label[:3, 3].tolist(),
        },
        "covariance": pose.covariance.tolist(),
        "rms_px": pose.rms_px,
    }


def _line(result: dict[str, Any]) -> str:
    """One picture for a person."""
    if result["error"] is not None:
        return f"{result['file']}: {result['error']['message']}"
    x, y, z = result["T_camera_label"]["translation_mm"]
    sigma = [result["covariance"][i][i] ** 0.5 for i in (3, 4, 5)]
    text = (
        f"{result['file']}: {result['payload']!r} at x {x:.3f} y {y:.3f} z {z:.3f} mm "
        f"(+-{sigma[0]:.3f} {sigma[1]:.3f} {sigma[2]:.3f}), "
        f"edges {result['rms_px']:.3f} px, {result['ms']:.1f} ms"
    )
    warning = result["warning"]
    return text if warning is None else f"{text}\n  warning: {warning['message']}"
