from __future__ import annotations

import json
import tomllib
from pathlib import Path

import cv2
import pytest
from click.testing import CliRunner, Result

from server.calibration.camera.calibration_file import versions
from server.calibration.camera.in_force import with_camera_calibration
from server.cli import main
from server.config import load_settings
from server.vision.camera_file import load_camera_file
from server.vision.errors import InvalidCameraFileError
from tests.server.calibration.camera.conftest import TRUTH, Picture

pytestmark = pytest.mark.usefixtures("clean_environment")


@pytest.fixture
def files(tmp_path: Path, pictures: list[Picture]) -> list[Path]:
    folder = tmp_path / "pictures"
    folder.mkdir()
    for name, image in pictures[:12]:
        assert cv2.imwrite(str(folder / name), image)
    return sorted(folder.iterdir())


def run(data: Path, *arguments: object) -> Result:
    words = ["calibrate", "camera", "--data-dir", data, *arguments]
    return CliRunner().invoke(main, [str(word) for word in words])


def test_every_run_is_kept_and_can_be_put_in_force(tmp_path: Path, files: list[Path]) -> None:
    first = run(tmp_path, *files)
    assert first.exit_code == 0, first.output
    assert "residual" in first.output
    second = run(tmp_path, "--json", *files)
    result = json.loads(second.stdout)
    kept = versions(tmp_path / "calibrations")
    assert list(kept) == [1, 2]
    assert result["file"] == str(kept[2])
    camera = load_camera_file(kept[2])
    assert camera.model_dump() == result["camera"]
    assert camera.fx == pytest.approx(TRUTH.fx, rel=0.01)
    provenance = tomllib.loads(kept[2].read_text())["calibration"]
    assert provenance["version"] == 2
    assert provenance["pictures"] == 12

    drawn = load_settings()
    assert with_camera_calibration(drawn) is drawn
    config = tmp_path / "robot.toml"
    config.write_text(f'[camera]\ncalibration = "{kept[2]}"\n')
    assert with_camera_calibration(load_settings(config)).camera.optics == camera


def test_the_size_of_the_squares_does_not_change_the_camera(
    tmp_path: Path, files: list[Path]
) -> None:
    results = [
        json.loads(run(tmp_path, "--json", "--square-mm", side, *files).stdout)
        for side in (24.0, 23.5)
    ]
    assert results[1]["camera"]["fx"] == pytest.approx(results[0]["camera"]["fx"], rel=1e-4)
    ratio = results[1]["views"][0]["distance_mm"] / results[0]["views"][0]["distance_mm"]
    assert ratio == pytest.approx(23.5 / 24.0, rel=1e-4)


def test_a_damaged_picture_is_named_and_nothing_is_kept(tmp_path: Path, files: list[Path]) -> None:
    files[3].write_bytes(b"")
    result = run(tmp_path, *files)
    assert result.exit_code == 2
    assert files[3].name in result.output
    assert not versions(tmp_path / "calibrations")


def test_a_missing_calibration_is_named(tmp_path: Path) -> None:
    config = tmp_path / "plugpilot.toml"
    config.write_text('[camera]\ncalibration = "nowhere.toml"\n')
    with pytest.raises(InvalidCameraFileError, match=r"nowhere\.toml cannot be read"):
        with_camera_calibration(load_settings(config))
