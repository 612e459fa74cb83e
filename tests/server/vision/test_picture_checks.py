"""Bad input is told by name before anything is computed from it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from server.vision import Locator
from server.vision.errors import NoCodeError, PictureTooBrightError, PictureTooDarkError
from server.vision.picture_checks import check_picture
from tests.server.vision.label_shots import CAMERA, SIZE_MM, shot_of
from tests.support.picture_taking import Shot


def test_a_dark_picture_is_told() -> None:
    image = shot_of(shot=Shot(exposure=0.0003))
    with pytest.raises(PictureTooDarkError) as caught:
        Locator(CAMERA).locate(image, label_size_mm=SIZE_MM)
    assert caught.value.code == "picture_too_dark"
    assert isinstance(caught.value, NoCodeError)


def test_a_clipped_picture_is_told() -> None:
    image = shot_of(shot=Shot(exposure=400.0))
    with pytest.raises(PictureTooBrightError) as caught:
        Locator(CAMERA).locate(image, label_size_mm=SIZE_MM)
    assert caught.value.code == "picture_too_bright"
    assert "%" in caught.value.detail


def test_an_ordinary_picture_without_a_label_is_neither() -> None:
    image = np.full((CAMERA.height, CAMERA.width), 110, dtype=np.uint8)
    with pytest.raises(NoCodeError) as caught:
        Locator(CAMERA).locate(image, label_size_mm=SIZE_MM)
    assert type(caught.value) is NoCodeError


def test_a_moderately_over_exposed_label_is_still_located() -> None:
    found = Locator(CAMERA).locate(shot_of(shot=Shot(exposure=3.0)), label_size_mm=SIZE_MM)
    assert found.translation_sigma_mm[0] < 0.01


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((0, 0), dtype=np.uint8),
        np.zeros((480, 640, 3), dtype=np.uint8),
        np.zeros((480, 640), dtype=np.float32),
    ],
    ids=["empty", "colour", "fractions"],
)
def test_what_is_no_grey_picture_is_a_mistake(image: NDArray[np.uint8]) -> None:
    with pytest.raises(ValueError, match="grey uint8"):
        check_picture(image)
