"""Calibrations of a camera as files, one a version, none ever overwritten.

A file is a camera file (see server/vision/camera_file.py) with a table ``[calibration]`` that says
where its numbers come from.
"""

from __future__ import annotations

import re
from datetime import datetime
from pathlib import Path

import tomlkit

from server.calibration.camera.errors import CameraCalibrationError
from server.calibration.camera.solve import CameraSolution
from server.calibration.camera.verdict import Verdict

FORMAT = 1
_NAME = re.compile(r"camera-([0-9]{4})\.toml")


def calibration_text(
    solution: CameraSolution, verdict: Verdict, made_at: datetime, version: int
) -> str:
    """The content of a calibration file."""
    document = tomlkit.document()
    document.add(tomlkit.comment("Camera model of PlugPilot: pixels, centres at whole numbers."))
    for name, value in solution.camera.model_dump().items():
        document.add(name, value)
    table = tomlkit.table()
    used = [view for view in solution.views if view.used]
    for name, value in {
        "format": FORMAT,
        "version": version,
        "made_at": made_at,
        "verdict": verdict.grade.value,
        "remarks": list(verdict.remarks),
        "pictures": len(used),
        "pictures_left_out": len(solution.views) - len(used),
        "rms_px": round(solution.rms_px, 4),
        "check_px": round(solution.check_px, 4),
        "sigma": {name: float(f"{value:.3g}") for name, value in solution.sigma.items()},
    }.items():
        table.add(name, value)
    document.add("calibration", table)
    return tomlkit.dumps(document)


def versions(folder: Path) -> dict[int, Path]:
    """The calibrations in a folder, oldest first."""
    found = {
        int(match[1]): path
        for path in (folder.iterdir() if folder.is_dir() else ())
        if (match := _NAME.fullmatch(path.name))
    }
    return dict(sorted(found.items()))


def keep(folder: Path, solution: CameraSolution, verdict: Verdict, made_at: datetime) -> Path:
    """Write the next version.

    Returns:
        Its file.

    Raises:
        CameraCalibrationError: it cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        while True:
            version = max(versions(folder), default=0) + 1
            path = folder / f"camera-{version:04d}.toml"
            text = calibration_text(solution, verdict, made_at, version)
            try:
                with path.open("x", encoding="utf-8") as file:
                    file.write(text)
            except FileExistsError:
                continue  # somebody else took this number
            return path
    except OSError as error:
        raise CameraCalibrationError(
            f"The calibration cannot be written to {folder}: {error.strerror}."
        ) from error
