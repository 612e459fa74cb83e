from __future__ import annotations

import math

import cv2
import numpy as np
import pytest

from server.calibration.camera.board_views import BoardViews, find_board
from server.calibration.camera.coverage import coverage_map, covered_share, uncovered_edges
from server.calibration.camera.errors import (
    MixedResolutionError,
    NoBoardError,
    WrongBoardError,
)
from server.calibration.camera.solve import CameraSolution, solve_camera
from server.calibration.camera.verdict import judge
from server.calibration.grade import Grade
from server.labels.board_layout import BoardLayout
from server.simulated_board import board_pictures
from tests.server.calibration.camera.conftest import LAYOUT, TRUTH, Picture


@pytest.fixture(scope="session")
def found(pictures: list[Picture]) -> BoardViews:
    return find_board(pictures, LAYOUT)


@pytest.fixture(scope="session")
def solution(found: BoardViews) -> CameraSolution:
    return solve_camera(found)


def test_the_camera_is_found_within_what_it_says_of_itself(solution: CameraSolution) -> None:
    camera = solution.camera
    for name in ("fx", "fy", "cx", "cy", "k1", "p1", "p2"):
        error = getattr(camera, name) - getattr(TRUTH, name)
        assert abs(error) < 3.5 * solution.sigma[name], name
    assert camera.fx == pytest.approx(TRUTH.fx, rel=0.003)
    assert math.hypot(camera.cx - TRUTH.cx, camera.cy - TRUTH.cy) < 2.0
    assert solution.rms_px < 0.4
    assert solution.check_px < 1.3 * solution.rms_px


def test_distances_and_tilts_are_those_of_the_pictures(solution: CameraSolution) -> None:
    assert all(200 < view.distance_mm < 600 for view in solution.views)
    assert max(view.tilt_rad for view in solution.views) > math.radians(20)


def test_a_good_set_is_called_good_or_usable(found: BoardViews, solution: CameraSolution) -> None:
    coverage = coverage_map(found.views, found.width_px, found.height_px)
    verdict = judge(solution, coverage)
    assert verdict.grade is not Grade.BAD
    assert covered_share(coverage) > 0.8


def test_a_bent_picture_is_left_out(pictures: list[Picture]) -> None:
    name, image = pictures[4]
    y, x = np.mgrid[0 : image.shape[0], 0 : image.shape[1]].astype(np.float32)
    waves = x + 4.0 * np.sin(y / 40.0).astype(np.float32)
    bent = np.asarray(cv2.remap(image, waves, y, cv2.INTER_LINEAR), dtype=np.uint8)
    solution = solve_camera(find_board([*pictures[:4], (name, bent), *pictures[5:]], LAYOUT))
    assert [view.name for view in solution.views if not view.used] == [name]
    assert abs(solution.camera.fx - TRUTH.fx) < 3.5 * solution.sigma["fx"]


def test_pictures_from_one_side_only_are_not_called_good(pictures: list[Picture]) -> None:
    one_side = [picture for number, picture in enumerate(pictures) if number % 3 == 0]
    found = find_board(one_side, LAYOUT)
    coverage = coverage_map(found.views, found.width_px, found.height_px)
    assert "right" in uncovered_edges(coverage)
    verdict = judge(solve_camera(found), coverage)
    assert verdict.grade is not Grade.GOOD
    assert any("right edge" in remark for remark in verdict.remarks)


def test_pictures_without_the_board_are_named(pictures: list[Picture]) -> None:
    empty = ("empty.png", np.full((480, 640), 90, dtype=np.uint8))
    found = find_board([empty, *pictures[:8]], LAYOUT)
    assert [name for name, _ in found.rejected] == ["empty.png"]
    assert "not in view" in found.rejected[0][1]


def test_too_few_pictures(pictures: list[Picture]) -> None:
    with pytest.raises(NoBoardError, match="in 3 of 3 pictures"):
        find_board(pictures[:3], LAYOUT)
    with pytest.raises(NoBoardError, match="no pictures"):
        find_board([], LAYOUT)


def test_pictures_of_different_sizes(pictures: list[Picture]) -> None:
    small = ("small.png", pictures[0][1][:400])
    with pytest.raises(MixedResolutionError, match=r"small\.png has 640 x 400"):
        find_board([pictures[0], small], LAYOUT)


def test_another_board(pictures: list[Picture]) -> None:
    with pytest.raises(WrongBoardError, match="no board of 4 x 5"):
        find_board(pictures, BoardLayout(columns=4, rows=5))


@pytest.mark.parametrize("other", [BoardLayout(columns=5, rows=7), BoardLayout(columns=9, rows=7)])
def test_another_board_is_named_and_never_makes_a_camera(other: BoardLayout) -> None:
    pictures = board_pictures(TRUTH, other, 9, np.random.default_rng(2))
    with pytest.raises(WrongBoardError, match="no board of 7 x 9 squares"):
        find_board(pictures, LAYOUT)
