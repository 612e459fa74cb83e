"""Which pictures of a held board are kept."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from server.calibration.camera.board_sight import BoardFinder, BoardSight
from server.calibration.camera.collecting import BoardCollection
from tests.server.calibration.camera.conftest import LAYOUT, TRUTH, Picture

LARGE = 2
_SCALED = ("width", "height", "fx", "fy", "cx", "cy")
OPTICS = TRUTH.model_copy(update={name: LARGE * getattr(TRUTH, name) for name in _SCALED})
FINDER = BoardFinder(LAYOUT, OPTICS)


def sight(image: NDArray[np.uint8], blur_px: float = 0.0) -> BoardSight:
    """What a picture shows once it is twice as large, and more blurred."""
    large = cv2.resize(image, None, fx=LARGE, fy=LARGE, interpolation=cv2.INTER_CUBIC)
    if blur_px:
        large = cv2.GaussianBlur(large, (0, 0), blur_px)
    return FINDER.find(np.asarray(large, dtype=np.uint8), "held")


@pytest.fixture
def kept() -> BoardCollection:
    return BoardCollection(OPTICS.width, OPTICS.height)


def test_blur_is_measured_in_pixels(pictures: list[Picture]) -> None:
    image = pictures[4][1]
    sharp, soft = sight(image).sharpness, sight(image, 1.6).sharpness
    assert sharp is not None
    assert soft is not None
    assert soft.square_px == pytest.approx(sharp.square_px, rel=0.05)
    assert soft.blur_px == pytest.approx(np.hypot(sharp.blur_px, 1.6), rel=0.15)


def test_only_what_stands_still_is_sharp_and_new_is_kept(
    pictures: list[Picture], kept: BoardCollection
) -> None:
    here, there = sight(pictures[0][1]), sight(pictures[4][1])
    assert kept.take(here, 0.0) == "moving"  # one picture does not say whether it stands
    assert kept.take(here, 0.2) == "taken"
    assert kept.take(here, 0.4) == "known"
    assert kept.take(there, 0.6) == "moving"
    assert kept.take(there, 0.8) == "taken"
    soft = sight(pictures[8][1], 2.2)
    assert kept.take(soft, 1.0) == "moving"
    assert kept.take(soft, 1.2) == "blurred"
    assert kept.take(BoardSight(markers=0), 1.4) == "no_board"
    assert kept.take(BoardSight(markers=3), 1.6) == "show_more"
    assert len(kept.views) == 2


def test_the_emptiest_part_of_the_picture_is_asked_for(
    pictures: list[Picture], kept: BoardCollection
) -> None:
    for name, image in pictures:
        number = int(name.removesuffix(".png"))
        if number % 3 == 0 and number < 9:  # at the left, from the top to the bottom
            found = sight(image)
            kept.take(found, float(number))
            assert kept.take(found, number + 0.2) == "taken"
    assert kept.wish.place in {"upper_right", "right", "lower_right"}
    assert not kept.complete
