"""The sheets as a printer would see them."""

from __future__ import annotations

import re
from pathlib import Path

import cv2
import numpy as np
import pytest
import zxingcpp
from click.testing import CliRunner, Result

from server.cli import main
from server.labels.board_layout import BoardLayout
from server.labels.drawing import PRINT_DPI, Paper
from server.labels.key_file import load_label_key
from server.labels.payload import label_text
from server.labels.ruler import TICK_MM

pytestmark = pytest.mark.usefixtures("clean_environment")

PX_PER_MM = PRINT_DPI / 25.4
PIXEL_MM = 1.5 / PX_PER_MM


def run(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["label", *(str(argument) for argument in arguments)])


def scan(path: Path) -> np.ndarray[tuple[int, int], np.dtype[np.uint8]]:
    picture = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    assert picture is not None
    return np.asarray(picture, dtype=np.uint8)


@pytest.mark.parametrize(("size_mm", "paper"), [(60, "a4"), (120, "a4"), (40, "letter")])
def test_the_label_is_printed_at_its_size(tmp_path: Path, size_mm: float, paper: str) -> None:
    path = tmp_path / "label.png"
    result = run(
        "zoe", "--size-mm", size_mm, "--paper", paper, "--data-dir", tmp_path, "--output", path
    )
    assert result.exit_code == 0, result.output
    picture = scan(path)
    sheet = Paper[paper.upper()]
    assert picture.shape[1] / PX_PER_MM == pytest.approx(sheet.width_mm, abs=0.1)
    assert picture.shape[0] / PX_PER_MM == pytest.approx(sheet.height_mm, abs=0.1)
    (code,) = zxingcpp.read_barcodes(picture)
    assert code.text == label_text("zoe", load_label_key(tmp_path))
    place = code.position
    assert (place.top_right.x - place.top_left.x) / PX_PER_MM == pytest.approx(size_mm, abs=0.1)
    assert (place.bottom_left.y - place.top_left.y) / PX_PER_MM == pytest.approx(size_mm, abs=0.1)


def test_the_ruler_is_true(tmp_path: Path) -> None:
    path = tmp_path / "label.png"
    assert run("zoe", "--data-dir", tmp_path, "--output", path).exit_code == 0
    longest_px = max(_longest_run(row) for row in scan(path) < 128)
    assert longest_px / PX_PER_MM == pytest.approx(100.0 + TICK_MM, abs=PIXEL_MM)


def _longest_run(row: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> int:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], row.astype(np.int8), [0]))))
    return int(np.max(edges[1::2] - edges[::2], initial=0))


def test_the_board_is_found_with_all_its_corners(tmp_path: Path) -> None:
    path = tmp_path / "board.png"
    assert run("--board", "--output", path).exit_code == 0
    layout = BoardLayout()
    corners, numbers, _, _ = cv2.aruco.CharucoDetector(layout.board).detectBoard(scan(path))
    assert len(numbers) == (layout.columns - 1) * (layout.rows - 1)
    seen_mm = np.asarray(corners).reshape(-1, 2) / PX_PER_MM
    drawn_mm = np.asarray(layout.board.getChessboardCorners())[np.ravel(numbers), :2]
    offset_mm = seen_mm - drawn_mm
    assert np.ptp(offset_mm, axis=0) == pytest.approx((0.0, 0.0), abs=2 * PIXEL_MM)


def test_a_tag_can_be_printed_instead(tmp_path: Path) -> None:
    path = tmp_path / "tag.png"
    assert run("zoe", "--tag", "tag36h11:17", "--output", path).exit_code == 0
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    _, numbers, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(scan(path)[::4, ::4].copy())
    assert np.ravel(numbers).tolist() == [17]


@pytest.mark.parametrize("suffix", ["pdf", "svg"])
def test_drawings_have_the_size_of_the_paper_and_no_date(tmp_path: Path, suffix: str) -> None:
    first, second = tmp_path / f"a.{suffix}", tmp_path / f"b.{suffix}"
    for path in (first, second):
        assert run("zoe", "--data-dir", tmp_path, "--output", path).exit_code == 0
    assert first.read_bytes() == second.read_bytes()
    if suffix == "pdf":
        box = re.search(rb"/MediaBox \[ 0 0 ([0-9.]+) ([0-9.]+) \]", first.read_bytes())
    else:
        box = re.search(rb'<svg [^>]*width="([0-9.]+)pt" height="([0-9.]+)pt"', _flat(first))
        if box is None:
            box = re.search(
                rb'<svg [^>]*height="([0-9.]+)pt"[^>]*width="([0-9.]+)pt"', _flat(first)
            )
    assert box is not None
    sides_mm = sorted(float(side) * 25.4 / 72 for side in box.groups())
    assert sides_mm == pytest.approx([210.0, 297.0], abs=0.01)


def _flat(path: Path) -> bytes:
    return path.read_bytes().replace(b"\n", b" ")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "Name the vehicle"),
        (("--board", "zoe"), "takes no vehicle"),
        (("zoe", "--size-mm", "5"), "30 to 120 mm can"),
        (("zoe", "--size-mm", "nan"), "30 to 120 mm can"),
        (("zo e",), "cannot be the id"),
        (("zoe", "--tag", "17"), "is no tag"),
        (("zoe", "--output", "label.doc"), "ends in none of .pdf, .svg, .png"),
        (("zoe", "--output", "/proc/none/label.pdf"), "cannot be written"),
    ],
)
def test_wrong_wishes_are_refused_in_words(
    tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    result = run(*arguments, "--data-dir", tmp_path)
    assert result.exit_code == 2
    assert words in result.output
    assert not list(tmp_path.glob("*.pdf"))
