from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from drivers.camera.errors import PicturesError
from drivers.camera.replay import ReplaySource
from drivers.camera.settings import ReplaySettings

QUICK = 240.0


def source(path: Path, *, repeat: bool = False) -> ReplaySource:
    return ReplaySource(ReplaySettings(path=path, frames_per_s=QUICK, repeat=repeat))


def put_pictures(folder: Path, values: dict[str, int]) -> None:
    for name, value in values.items():
        assert cv2.imwrite(str(folder / name), np.full((24, 32), value, dtype=np.uint8))


def test_pictures_come_in_the_order_of_their_names(tmp_path: Path) -> None:
    put_pictures(tmp_path, {"b.png": 20, "a.png": 10, "c.PNG": 30})
    (tmp_path / "notes.txt").write_text("not a picture")
    pictures = source(tmp_path)
    pictures.open()
    assert [int(pictures.read().image[0, 0]) for _ in range(3)] == [10, 20, 30]
    with pytest.raises(PicturesError, match="come to its end"):
        pictures.read()


def test_they_begin_again_when_wanted(tmp_path: Path) -> None:
    put_pictures(tmp_path, {"a.png": 10, "b.png": 20})
    pictures = source(tmp_path, repeat=True)
    pictures.open()
    assert [int(pictures.read().image[0, 0]) for _ in range(5)] == [10, 20, 10, 20, 10]


def test_a_video_plays_to_its_end(tmp_path: Path) -> None:
    path = tmp_path / "video.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (64, 48))
    for value in (40, 120, 200):
        writer.write(np.full((48, 64, 3), value, dtype=np.uint8))
    writer.release()
    video = source(path)
    video.open()
    values = [int(video.read().image.mean()) for _ in range(3)]
    assert values == pytest.approx([40, 120, 200], abs=4)
    with pytest.raises(PicturesError, match="come to its end"):
        video.read()


def test_what_is_no_picture_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.png").touch()
    pictures = source(tmp_path)
    pictures.open()
    with pytest.raises(PicturesError, match=r"a\.png is empty or no picture"):
        pictures.read()


def test_what_is_no_video_is_named(tmp_path: Path) -> None:
    path = tmp_path / "video.avi"
    path.write_bytes(b"nothing of that kind")
    video = source(path)
    video.open()
    with pytest.raises(PicturesError, match="empty or no video"):
        video.read()


def test_missing_and_empty_folders_are_named(tmp_path: Path) -> None:
    with pytest.raises(PicturesError, match=r"There is no .*nowhere"):
        source(tmp_path / "nowhere").open()
    with pytest.raises(PicturesError, match="There is no picture in"):
        source(tmp_path).open()
