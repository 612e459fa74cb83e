from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from tests.twin.workspace.robots import (
    DEFAULT,
    LONG_STROKES,
    NEAR_MM,
    UNEVEN,
    grid_over,
    robots,
    stroke_left,
)
from twin.geometry import JointRange, RobotGeometry
from twin.kinematics import PlatformPosition, SingularityLimits, alpha, singularity
from twin.workspace import (
    ArcPolygon,
    EmptyWorkspaceError,
    Limit,
    Rectangle,
    paper_discs,
    reachable_region,
    usable_region,
)

SPECIAL = [DEFAULT, LONG_STROKES, UNEVEN]


def assert_agrees_with_the_scan(geometry: RobotGeometry, region: ArcPolygon, count: int) -> None:
    """Every grid point is decided alike, and the area is that of the cells but for the border."""
    points, cell = grid_over(region, count)
    left = stroke_left(geometry, points)
    decided = ~(np.abs(left) < NEAR_MM)
    np.testing.assert_array_equal(region.contains_many(points)[decided], (left >= 0)[decided])
    x_step, y_step = points[0, 1, 0] - points[0, 0, 0], points[1, 0, 1] - points[0, 0, 1]
    border = region.perimeter_mm * math.hypot(x_step, y_step)
    assert region.area_mm2 == pytest.approx(cell * float((left >= 0).sum()), abs=border)


@pytest.mark.parametrize("geometry", SPECIAL)
def test_the_region_is_the_set_of_the_inverse_kinematics(geometry: RobotGeometry) -> None:
    assert_agrees_with_the_scan(geometry, reachable_region(geometry), 601)


@settings(max_examples=60)
@given(robots())
def test_so_it_is_for_any_robot(geometry: RobotGeometry) -> None:
    assert_agrees_with_the_scan(geometry, reachable_region(geometry), 81)


@settings(max_examples=60)
@given(robots())
def test_the_boundary_is_one_closed_loop_of_what_really_bounds(geometry: RobotGeometry) -> None:
    region = reachable_region(geometry)
    (loop,) = region.loops
    assert region.area_mm2 > 0  # counterclockwise
    for piece, following in zip(loop, [*loop[1:], loop[0]], strict=True):
        assert math.dist(piece.end, following.start) <= 1e-8
        assert piece.end.y_mm == following.start.y_mm
    for piece in loop:
        middle = piece.points(3)[1]
        # beyond flat or upright legs rounding would leave no pose at all
        middle[1] += {Limit.ASSEMBLY_SIDE: 1e-9, Limit.LEG_LENGTH: -1e-9}.get(piece.limit, 0.0)
        # near an upright leg the joint moves by the square root
        assert stroke_left(geometry, middle) >= -1e-2
        if piece.limit.value.startswith("rho"):
            rho = dict(zip(("rho1", "rho2"), alpha.inverse_many(geometry, middle), strict=True))
            name, end = piece.limit.value.split("_")
            travel = getattr(geometry, name)
            wanted = travel.min_mm if end == "min" else travel.max_mm
            assert rho[name] == pytest.approx(wanted, abs=1e-4), piece


def test_the_default_region() -> None:
    """Figures worked out by hand from the four circles."""
    region = reachable_region(DEFAULT)
    # left end of rho2, right end of rho1: both circles of 532 mm are 350 mm apart
    highest = math.sqrt(532**2 - 175**2)
    assert region.extent == pytest.approx((440, 860, 0, highest))
    assert [piece.limit for piece in region.pieces] == [
        Limit.RHO2_MIN,
        Limit.RHO1_MAX,
        Limit.RHO2_MAX,
        Limit.RHO1_MIN,
        Limit.ASSEMBLY_SIDE,
    ]
    # folded flat the platform may be anywhere between both starts
    assert region.pieces[-1].start == pytest.approx((1190 - 532 - 55 - 16, 0), abs=1e-9)


def test_long_strokes_reach_what_the_four_discs_exclude() -> None:
    """The discs bound the leaning of legs that is not used, too."""
    region = reachable_region(LONG_STROKES)
    points, _ = grid_over(region, 121, 0)
    reached = stroke_left(LONG_STROKES, points) >= 0
    np.testing.assert_array_equal(region.contains_many(points), reached)
    allowed = np.array(
        [
            paper_discs(LONG_STROKES, Rectangle.square(x, y, 1e-9)).all_hold
            for x, y in points.reshape(-1, 2)
        ]
    ).reshape(reached.shape)
    wrong = points[reached & ~allowed]
    assert len(wrong) > 500
    assert wrong.min(axis=0) == pytest.approx((302, 402), abs=8)
    assert wrong.max(axis=0) == pytest.approx((998, 530), abs=8)
    assert not (allowed & ~reached).any()
    assert Limit.LEG_LENGTH in {piece.limit for piece in region.pieces}


def test_moderate_strokes_reach_what_the_four_discs_allow() -> None:
    points, _ = grid_over(reachable_region(DEFAULT), 101)
    for x, y in points.reshape(-1, 2):
        allowed = paper_discs(DEFAULT, Rectangle.square(x, y, 1e-9)).all_hold
        assert allowed == (stroke_left(DEFAULT, np.array([x, y])) >= 0), (x, y)


def test_uneven_carriages_fold_flat_halfway_between_their_heights() -> None:
    assert reachable_region(UNEVEN).extent.y_min_mm == pytest.approx(40)
    alpha.inverse(UNEVEN, PlatformPosition(650, 40.001))


@pytest.mark.parametrize(
    ("change", "reason", "sentence"),
    [
        (
            {"leg_length_mm": 120.0},
            "legs_too_short",
            r"feet stay 350 mm apart and the legs bridge at most 240 mm",
        ),
        (
            {"rho1": JointRange(min_mm=900, max_mm=950), "e1y_mm": 300.0, "e2y_mm": -300.0},
            "carriages_cross",
            r"come at most 290 mm apart",
        ),
        (
            {"e1y_mm": 600.0, "e2y_mm": -600.0},
            "carriages_too_far_in_height",
            r"run 1200 mm apart in height",
        ),
    ],
)
def test_robots_that_reach_nothing(change: dict[str, float], reason: str, sentence: str) -> None:
    geometry = DEFAULT.model_copy(update=change)  # without the checks of configuration
    points = np.random.default_rng(0).uniform((-500, -800), (1800, 1200), (20_000, 2))
    assert (stroke_left(geometry, points) < 0).all()
    with pytest.raises(EmptyWorkspaceError, match=sentence) as caught:
        reachable_region(geometry)
    assert caught.value.code == "empty_workspace"
    assert caught.value.context["reason"] == reason


def assert_usable_where_the_singularities_are_far(
    geometry: RobotGeometry, limits: SingularityLimits, count: int
) -> ArcPolygon:
    region = usable_region(geometry, limits)
    points, _ = grid_over(reachable_region(geometry), count)
    left = stroke_left(geometry, points)
    rho = alpha.inverse_many(geometry, points)
    room = (
        singularity.measures_many(geometry, rho) - np.array(singularity.thresholds(limits))
    ).min(axis=-1)
    decided = ~(np.abs(left) < NEAR_MM) & ~(np.abs(room) < 1e-9) & ~(np.isnan(room) & (left >= 0))
    expected = (left >= 0) & (room >= 0)
    np.testing.assert_array_equal(region.contains_many(points)[decided], expected[decided])
    return region


@settings(max_examples=40)
@given(robots())
def test_the_usable_region_is_what_the_singularity_check_accepts(geometry: RobotGeometry) -> None:
    assert_usable_where_the_singularities_are_far(geometry, SingularityLimits(), 61)


def test_a_flat_parallelogram_cuts_the_usable_region_into_two() -> None:
    geometry = RobotGeometry(e_py_mm=40)
    region = assert_usable_where_the_singularities_are_far(geometry, SingularityLimits(), 301)
    assert len(region.loops) == 2
    assert Limit.PARALLELOGRAM in {piece.limit for piece in region.pieces}


def test_limits_of_zero_change_nothing() -> None:
    limits = SingularityLimits(parallel=0, serial=0, parallelogram=0)
    whole = reachable_region(UNEVEN)
    assert usable_region(UNEVEN, limits).area_mm2 == pytest.approx(whole.area_mm2)


def test_limits_that_no_pose_keeps() -> None:
    assert usable_region(UNEVEN, SingularityLimits(serial=0.99, parallel=0.9)).is_empty
    assert usable_region(DEFAULT, SingularityLimits(parallelogram=0.95, serial=0.9)).is_empty
