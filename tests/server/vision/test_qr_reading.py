"""Finding and reading codes."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
import segno
from numpy.typing import NDArray

from server.vision.markers.qr_reading import find_codes
from tests.server.vision.pictures import PAYLOAD, SIZE_MM, flat_code, picture, pose, view
from twin.qr_label import label_modules

MODULES = label_modules(PAYLOAD)


def outline(module_px: int, margin: int = 4, count: int = len(MODULES)) -> NDArray[np.float64]:
    """Corners of a flat code, pixel centres at integers: its outer edge is half a pixel away."""
    first, last = margin * module_px - 0.5, (margin + count) * module_px - 0.5
    return np.array([(first, first), (last, first), (last, last), (first, last)])


def test_a_flat_code_is_read_with_corners_and_modules() -> None:
    (code,) = find_codes(flat_code(MODULES, 8))
    assert code.payload == PAYLOAD
    assert not code.mirrored
    np.testing.assert_array_equal(code.modules, MODULES)
    np.testing.assert_allclose(code.corners_px, outline(8), atol=0.51)


@pytest.mark.parametrize("quarter_turns", [1, 2, 3])
def test_corners_follow_the_code_when_it_is_turned(quarter_turns: int) -> None:
    (code,) = find_codes(np.ascontiguousarray(np.rot90(flat_code(MODULES, 8), -quarter_turns)))
    np.testing.assert_array_equal(code.modules, MODULES)
    expected = np.roll(outline(8), -quarter_turns, axis=0)
    np.testing.assert_allclose(code.corners_px, expected, atol=0.51)


@pytest.mark.parametrize("error", ["l", "m", "q", "h"])
@pytest.mark.parametrize(("version", "mask"), [(1, 0), (2, 7), (4, 3), (7, 2), (10, 5)])
def test_codes_made_elsewhere_are_read_with_their_own_modules(
    error: str, version: int, mask: int
) -> None:
    made = segno.make("car 42", version=version, error=error, mask=mask, boost_error=False)
    modules = np.array(made.matrix, dtype=np.bool_)
    (code,) = find_codes(flat_code(modules, 6))
    assert code.payload == "car 42"
    np.testing.assert_array_equal(code.modules, modules)


def test_a_mirrored_code_is_read_and_marked() -> None:
    (code,) = find_codes(np.ascontiguousarray(flat_code(MODULES, 8)[:, ::-1]))
    assert code.payload == PAYLOAD
    assert code.mirrored


def test_white_on_black_is_read() -> None:
    (code,) = find_codes(255 - flat_code(MODULES, 8))
    assert code.payload == PAYLOAD
    np.testing.assert_array_equal(code.modules, MODULES)


def test_line_ends_and_umlauts_arrive_unchanged() -> None:
    text = "Auto für Zoë\r\nline 2\r\n"
    modules = np.array(segno.make(text, error="q").matrix, dtype=np.bool_)
    assert find_codes(flat_code(modules, 6))[0].payload == text


def test_several_codes_come_largest_first() -> None:
    other = np.array(segno.make("other", micro=False).matrix, dtype=np.bool_)
    small, large = flat_code(other, 5), flat_code(MODULES, 9)
    sheet = np.full((700, 700), 230, dtype=np.uint8)
    sheet[20 : 20 + len(small), 20 : 20 + len(small)] = small
    sheet[300 : 300 + len(large), 300 : 300 + len(large)] = large
    assert [code.payload for code in find_codes(sheet)] == [PAYLOAD, "other"]


@pytest.mark.parametrize(
    ("what", "distance_mm", "imaging"),
    [
        ("far", 900.0, {}),
        ("out of focus", 85.0, {}),
        ("dim and noisy", 300.0, {"ambient": 0.02}),
        ("lamp at one side", 300.0, {"illumination_gradient": 1.0}),
    ],
)
def test_hard_pictures_are_read(what: str, distance_mm: float, imaging: dict[str, float]) -> None:
    del what
    scene = view(pose((0.0, 0.0, distance_mm), (3.0, -2.0, 180.0)))
    codes = find_codes(picture(scene, 0, **imaging))
    assert [code.payload for code in codes] == [PAYLOAD]


def test_a_tiny_code_is_read_in_an_enlarged_picture_and_its_corners_are_scaled_back() -> None:
    fine = flat_code(MODULES, 12)
    picture_of_code = cv2.resize(fine, None, fx=0.115, fy=0.115, interpolation=cv2.INTER_AREA)
    image = np.full((200, 240), 230, dtype=np.uint8)
    rows, columns = picture_of_code.shape
    image[50 : 50 + rows, 70 : 70 + columns] = picture_of_code
    (code,) = find_codes(image)
    assert code.payload == PAYLOAD
    expected = (outline(12) + 0.5) * 0.115 - 0.5 + (70, 50)
    np.testing.assert_allclose(code.corners_px, expected, atol=1.0)


def test_the_search_goes_on_until_the_wanted_code_is_found() -> None:
    scene = view(pose((-30.0, 0.0, 300.0)))
    image = picture(scene)
    other = flat_code(np.array(segno.make("other", micro=False).matrix, dtype=np.bool_), 4)
    image[40 : 40 + len(other), 40 : 40 + len(other)] = other
    assert {code.payload for code in find_codes(image, wanted=PAYLOAD)} == {PAYLOAD, "other"}
    assert {code.payload for code in find_codes(image, wanted="third")} == {PAYLOAD, "other"}


@pytest.mark.parametrize("grey", [0, 255])
def test_nothing_is_found_in_nothing(grey: int) -> None:
    assert find_codes(np.full((480, 640), grey, dtype=np.uint8)) == []
    noise = np.random.default_rng(1).integers(0, 256, (240, 320), dtype=np.uint8)
    assert find_codes(noise) == []


def test_label_size_is_that_of_the_pictures() -> None:
    """The corners of a rendered label are those that its pose predicts."""
    (code,) = find_codes(picture(view(pose((0.0, 0.0, 300.0)))))
    side = np.linalg.norm(code.corners_px[1] - code.corners_px[0])
    assert side == pytest.approx(1359.4 * SIZE_MM / 300.0, abs=2.0)
