"""Camera models in TOML files."""

from __future__ import annotations

from pathlib import Path

import pytest

from drivers.camera import CameraModel
from server.vision.camera_file import load_camera_file
from server.vision.errors import InvalidCameraFileError

GOOD = "width = 1640\nheight = 1232\nfx = 1359.4\nfy = 1358\ncx = 820.1\ncy = 615.2\n"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "camera.toml"


def test_missing_distortion_is_none(file: Path) -> None:
    file.write_text(GOOD + "k1 = -0.03\n", encoding="utf-8")
    expected = CameraModel(
        width=1640, height=1232, fx=1359.4, fy=1358.0, cx=820.1, cy=615.2, k1=-0.03
    )
    assert load_camera_file(file) == expected


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (GOOD + "k9 = 1.0\n", ("k9", "1.0", "k1, k2, p1, p2, k3")),
        (GOOD.replace("fx = 1359.4", "fx = -3.5"), ("fx", "-3.5", "greater than 0")),
        (GOOD.replace("fx = 1359.4\n", ""), ("fx is missing", "focal length")),
        (GOOD.replace("1640", "1640.5"), ("width", "1640.5", "whole number")),
        (GOOD.replace("820.1", "'wide'"), ("cx", "'wide'", "finite")),
        (GOOD.replace("820.1", "inf"), ("cx", "inf", "finite")),
        ("width = = 3", ("not TOML",)),
        ("\udcff", ("not TOML",)),
    ],
    ids=["unknown", "negative", "missing", "fraction", "text", "infinite", "syntax", "encoding"],
)
def test_a_wrong_file_is_told_with_key_value_and_what_is_allowed(
    file: Path, content: str, words: tuple[str, ...]
) -> None:
    file.write_bytes(content.encode("utf-8", "surrogateescape"))
    with pytest.raises(InvalidCameraFileError) as caught:
        load_camera_file(file)
    for word in (str(file), *words):
        assert word in caught.value.detail
    assert caught.value.code == "invalid_camera_file"


def test_every_fault_is_named_at_once(file: Path) -> None:
    file.write_text("width = 0\nheight = 480\n", encoding="utf-8")
    with pytest.raises(InvalidCameraFileError) as caught:
        load_camera_file(file)
    for key in ("width", "fx", "fy", "cx", "cy"):
        assert f"{key} " in caught.value.detail


def test_a_missing_file_and_a_folder_are_told(tmp_path: Path) -> None:
    for path in (tmp_path / "none.toml", tmp_path):
        with pytest.raises(InvalidCameraFileError, match="cannot be read"):
            load_camera_file(path)
