"""Camera models in TOML files."""

from __future__ import annotations

import tomllib
from pathlib import Path

from pydantic import ValidationError

from drivers.camera import CameraModel
from server.vision.errors import InvalidCameraFileError


def load_camera_file(path: Path) -> CameraModel:
    """Read width, height, fx, fy, cx, cy and the distortion k1, k2, p1, p2, k3 (0 if missing).

    A table [calibration], which says where the numbers come from, is passed over.

    Raises:
        InvalidCameraFileError: the file is missing, is not TOML, lacks a key or has a wrong one.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        detail = f"The camera file {path} cannot be read: {error.strerror or error}."
        raise InvalidCameraFileError(detail) from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        detail = f"The camera file {path} is not TOML: {error}."
        raise InvalidCameraFileError(detail) from error
    content.pop("calibration", None)
    try:
        return CameraModel.model_validate(content)
    except ValidationError as error:
        sentences = " ".join(_sentence(dict(problem)) for problem in error.errors())
        detail = f"The camera file {path} is wrong. {sentences}"
        raise InvalidCameraFileError(detail) from error


def _sentence(problem: dict[str, object]) -> str:
    """Name the key, what was given and what is allowed."""
    location = problem["loc"]
    key = ".".join(map(str, location)) if isinstance(location, tuple) else str(location)
    if problem["type"] == "missing":
        return f"{key} is missing: give {_allowed(key)}."
    if problem["type"] == "extra_forbidden":
        known = ", ".join(CameraModel.model_fields)
        return f"{key} = {problem['input']!r} is no key of a camera file: allowed are {known}."
    return f"{key} = {problem['input']!r} is not allowed: give {_allowed(key)}."


def _allowed(key: str) -> str:
    if key in {"width", "height"}:
        return "a whole number of pixels from 1 to 16384"
    if key in {"fx", "fy"}:
        return "a focal length in pixels greater than 0"
    if key in {"cx", "cy"}:
        return "a finite number of pixels"
    return "a finite number"
