"""The defaults are the paper's robot, and nothing can be changed behind the scenes."""

from __future__ import annotations

import math

import pytest
from pydantic import ValidationError

from server.config import Settings
from server.config.insertion import InsertionSettings
from twin.geometry import RobotGeometry


def test_the_default_camera_sees_62_degrees() -> None:
    optics = Settings().camera.optics
    half_width_px = optics.width / 2
    assert math.degrees(2 * math.atan(half_width_px / optics.fx)) == pytest.approx(62.2)
    assert (optics.cx, optics.cy) == ((optics.width - 1) / 2, (optics.height - 1) / 2)


def test_settings_are_frozen() -> None:
    settings = Settings()
    with pytest.raises(ValidationError, match="frozen"):
        settings.server.port = 1  # type: ignore[misc]  # that is the point
    with pytest.raises(ValidationError, match="frozen"):
        settings.geometry = RobotGeometry()  # type: ignore[misc]  # that is the point


def test_the_parts_must_fit_together_in_code_too() -> None:
    with pytest.raises(ValidationError, match="slide is too short"):
        Settings(
            geometry=RobotGeometry.model_validate({"rho3": {"min_mm": 50, "max_mm": 120}}),
            insertion=InsertionSettings(depth_mm=60),
        )
