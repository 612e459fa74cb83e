"""`plugpilot locate` as a person and as a program calls it."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from click.testing import CliRunner
from numpy.typing import NDArray

from server.cli.locate import locate
from server.vision.markers.april_tags import tag_modules
from tests.server.vision.label_shots import CAMERA, PLACE, shot_of
from tests.server.vision.pictures import OPTICS, PAYLOAD, picture, pose, pose_error, view
from tests.support.label_prints import printed

TRUE = pose((3.0, -4.0, 290.0), (1.0, -1.5, 180.0))
FIELDS = {
    "file", "payload", "T_camera_label", "covariance", "rms_px", "ms", "warning", "error",
}  # fmt: skip


@pytest.fixture
def camera_file(tmp_path: Path) -> Path:
    path = tmp_path / "camera.toml"
    lines = [f"{key} = {value!r}" for key, value in OPTICS.model_dump().items()]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


@pytest.fixture
def label_file(tmp_path: Path) -> Path:
    return saved(tmp_path / "label.png", picture(view(TRUE)))


def saved(path: Path, image: NDArray[np.uint8]) -> Path:
    path.write_bytes(cv2.imencode(".png", image)[1].tobytes())
    return path


def run(camera: Path, *arguments: str | Path, status: int = 0) -> list[dict[str, Any]]:
    words = [*map(str, arguments), "--camera", str(camera), "--label-size-mm", "60", "--json"]
    result = CliRunner().invoke(locate, words)
    assert result.exit_code == status, result.output
    lines = [json.loads(line) for line in result.stdout.splitlines()]
    assert all(set(line) == FIELDS for line in lines)
    return lines


def test_one_json_object_per_picture(camera_file: Path, label_file: Path) -> None:
    lines = run(camera_file, label_file, label_file)
    assert len(lines) == 2
    first = lines[0]
    assert first["file"] == str(label_file)
    assert first["payload"] == PAYLOAD
    assert first["error"] is None
    assert first["warning"] is None
    assert 0 < first["rms_px"] < 0.1
    assert first["ms"] > 0
    found = np.eye(4)
    found[:3, :3] = first["T_camera_label"]["rotation"]
    found[:3, 3] = first["T_camera_label"]["translation_mm"]
    error = pose_error(found, TRUE)
    covariance = np.array(first["covariance"])
    assert covariance.shape == (6, 6)
    assert error @ np.linalg.solve(covariance, error) < 25.0


def test_a_bad_picture_stands_in_its_line_and_the_others_are_still_done(
    camera_file: Path, label_file: Path, tmp_path: Path
) -> None:
    text = tmp_path / "text.png"
    text.write_text("no picture", encoding="utf-8")
    empty = saved(tmp_path / "empty.png", np.full((1232, 1640), 90, dtype=np.uint8))
    lines = run(camera_file, text, empty, tmp_path / "none.png", label_file, status=1)
    codes = [line["error"] and line["error"]["code"] for line in lines]
    assert codes == ["image_unreadable", "no_code", "image_unreadable", None]
    for line in lines[:3]:
        assert line["error"]["message"]
        assert all(line[key] is None for key in FIELDS - {"file", "error"})
    assert lines[3]["payload"] == PAYLOAD


def test_another_resolution_is_located_with_a_warning(camera_file: Path, tmp_path: Path) -> None:
    """The top left part of a picture has the pixel coordinates of the whole."""
    part = saved(tmp_path / "part.png", picture(view(TRUE))[:900, :1200])
    (line,) = run(camera_file, part)
    assert line["error"] is None
    assert line["warning"]["code"] == "resolution_mismatch"
    assert "1200 x 900" in line["warning"]["message"]
    translation = line["T_camera_label"]["translation_mm"]
    np.testing.assert_allclose(translation, TRUE[:3, 3], atol=0.05)


def test_a_code_whose_edges_do_not_fit_is_located_by_its_corners(
    camera_file: Path, tmp_path: Path
) -> None:
    image = picture(view(TRUE))
    shift = np.round(6 * np.sin((np.arange(1232) - 616.0) / 60.0)).astype(int)
    columns = np.clip(np.arange(1640) + shift[:, None], 0, 1639)
    (line,) = run(camera_file, saved(tmp_path / "b.png", np.take_along_axis(image, columns, 1)))
    assert line["payload"] == PAYLOAD
    assert line["error"] is None
    assert line["warning"]["code"] == "corners_only"
    assert line["covariance"][5][5] > 0.1


def test_a_mirrored_code_is_read_but_not_located(camera_file: Path, tmp_path: Path) -> None:
    mirrored = saved(tmp_path / "m.png", np.ascontiguousarray(picture(view(TRUE))[:, ::-1]))
    (line,) = run(camera_file, mirrored, status=1)
    assert line["payload"] == PAYLOAD
    assert line["T_camera_label"] is None
    assert line["error"]["code"] == "mirrored_code"


def test_only_the_wanted_text_is_accepted(camera_file: Path, label_file: Path) -> None:
    (line,) = run(camera_file, label_file, "--payload", "another", status=1)
    assert line["error"]["code"] == "wrong_payload"
    assert run(camera_file, label_file, "--payload", PAYLOAD)[0]["error"] is None


def test_a_tag_is_located_when_asked_for(tmp_path: Path) -> None:
    camera = tmp_path / "small.toml"
    lines = [f"{key} = {value!r}" for key, value in CAMERA.model_dump().items()]
    camera.write_text("\n".join(lines), encoding="utf-8")
    label = printed(tag_modules("tag36h11:4"), 60.0)
    file = saved(tmp_path / "tag.png", shot_of(label))
    assert run(camera, file, status=1)[0]["error"]["code"] == "no_code"
    (line,) = run(camera, file, "--marker", "apriltag")
    assert line["payload"] == "tag36h11:4"
    translation = line["T_camera_label"]["translation_mm"]
    np.testing.assert_allclose(translation, PLACE[:3, 3], atol=0.05)


@pytest.mark.parametrize(
    ("content", "code"),
    [(b"", "image_unreadable"), (b"\xff\xd8\xff\xe0broken", "image_unreadable")],
)
def test_an_empty_or_broken_file_is_told(
    camera_file: Path, tmp_path: Path, content: bytes, code: str
) -> None:
    file = tmp_path / "broken.jpg"
    file.write_bytes(content)
    assert run(camera_file, file, status=1)[0]["error"]["code"] == code


def test_pictures_without_light_or_with_too_much_are_told(
    camera_file: Path, tmp_path: Path
) -> None:
    dark = saved(tmp_path / "dark.png", np.full((1232, 1640), 3, dtype=np.uint8))
    bright = saved(tmp_path / "bright.png", np.full((1232, 1640), 255, dtype=np.uint8))
    lines = run(camera_file, dark, bright, status=1)
    codes = [line["error"]["code"] for line in lines]
    assert codes == ["picture_too_dark", "picture_too_bright"]


def test_a_person_gets_a_readable_line(camera_file: Path, label_file: Path, tmp_path: Path) -> None:
    arguments = [str(label_file), str(tmp_path / "none.png")]
    options = ["--camera", str(camera_file), "--label-size-mm", "60"]
    result = CliRunner().invoke(locate, [*arguments, *options])
    assert result.exit_code == 1
    good, bad = result.stdout.splitlines()
    assert PAYLOAD in good
    seen = re.search(r" z (\S+) mm", good)
    assert seen is not None
    assert float(seen[1]) == pytest.approx(290.0, abs=0.02)
    assert "none.png" in bad


@pytest.mark.parametrize("size", ["0", "-60", "big"])
def test_a_wrong_label_size_is_a_usage_error(
    camera_file: Path, label_file: Path, size: str
) -> None:
    words = [str(label_file), "--camera", str(camera_file), "--label-size-mm", size]
    result = CliRunner().invoke(locate, words)
    assert result.exit_code == 2
    assert "--label-size-mm" in result.output
