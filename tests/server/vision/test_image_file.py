"""Pictures in files."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from server.vision.errors import ImageUnreadableError
from server.vision.image_file import load_grey_image

GREY = np.arange(48, dtype=np.uint8).reshape(6, 8) * 5


@pytest.mark.parametrize("ending", ["png", "webp", "jpg", "bmp"])
def test_pictures_are_read_as_grey_values(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"größe.{ending}"
    path.write_bytes(cv2.imencode(f".{ending}", cv2.merge([GREY] * 3))[1].tobytes())
    image = load_grey_image(path)
    assert image.dtype == np.uint8
    np.testing.assert_allclose(image.astype(int), GREY, atol=0 if ending in {"png", "bmp"} else 12)


def test_an_orientation_note_is_not_followed(tmp_path: Path) -> None:
    """Intrinsics belong to the pixels of the sensor, not to a turned picture."""
    path = tmp_path / "turned.jpg"
    jpeg = cv2.imencode(".jpg", GREY)[1].tobytes()
    tiff = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"
    exif = b"Exif\0\0" + tiff
    path.write_bytes(jpeg[:2] + b"\xff\xe1" + (len(exif) + 2).to_bytes(2, "big") + exif + jpeg[2:])
    assert cv2.imread(str(path), cv2.IMREAD_GRAYSCALE).shape == (8, 6)  # type: ignore[union-attr]
    assert load_grey_image(path).shape == (6, 8)


@pytest.mark.parametrize("content", [b"", b"not a picture", b"\x89PNG\r\n\x1a\n" + b"\0" * 40])
def test_what_is_no_picture_is_told(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "picture.png"
    path.write_bytes(content)
    with pytest.raises(ImageUnreadableError, match=r"picture\.png is not a picture") as caught:
        load_grey_image(path)
    assert caught.value.code == "image_unreadable"


def test_a_missing_picture_is_told(tmp_path: Path) -> None:
    with pytest.raises(ImageUnreadableError, match="cannot be read"):
        load_grey_image(tmp_path / "none.png")
