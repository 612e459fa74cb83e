from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.twin.strategies import between
from tests.twin.workspace.robots import DEFAULT, UNEVEN, robots
from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import inverse_many, within_limits_many
from twin.workspace import (
    InvalidRectangleError,
    RectangleOutsideError,
    TipBox,
    deepest_box,
    deepest_box_at,
    largest_rectangle,
    placement_region,
    reachable_region,
    tip_box_margins,
    tip_depth_range,
    tip_slice,
    tip_volume_mm3,
)

REGULAR = TipBox.regular(DEFAULT)


@pytest.mark.parametrize("geometry", [DEFAULT, UNEVEN])
def test_slices_are_what_the_inverse_kinematics_reaches(geometry: RobotGeometry) -> None:
    low, high = tip_depth_range(geometry)
    assert tip_slice(geometry, low - 0.01).is_empty
    assert tip_slice(geometry, high + 0.01).is_empty
    for z in np.linspace(low, high, 5):
        region = tip_slice(geometry, float(z))
        x_min, x_max, y_min, y_max = region.extent
        rng = np.random.default_rng(3)
        tips = rng.uniform((x_min - 20, y_min - 20, z), (x_max + 20, y_max + 20, z), (4000, 3))
        reached = within_limits_many(geometry, inverse_many(geometry, tips))
        np.testing.assert_array_equal(region.contains_many(tips[:, :2]), reached)
        assert region.area_mm2 == pytest.approx(reachable_region(geometry).area_mm2)


def test_the_volume_is_that_of_many_random_tips() -> None:
    low, high = tip_depth_range(DEFAULT)
    corner, opposite = np.array([430.0, -50.0, low - 10]), np.array([870.0, 520.0, high + 10])
    tips = np.random.default_rng(5).uniform(corner, opposite, (200_000, 3))
    share = within_limits_many(DEFAULT, inverse_many(DEFAULT, tips)).mean()
    assert tip_volume_mm3(DEFAULT) == pytest.approx(share * np.prod(opposite - corner), rel=0.01)


def test_the_regular_box() -> None:
    """200 x 200 x 20 mm of tip positions need 200 x 203.5 mm of the platform."""
    margins = tip_box_margins(DEFAULT, REGULAR)
    rise = 20 * math.tan(math.radians(10))
    assert margins.platform.height_mm == pytest.approx(200 + rise)
    assert margins.platform.center_x_mm == 650
    assert margins.platform.center_y_mm == pytest.approx(335)
    assert margins.fits
    assert margins.smallest_mm == pytest.approx(16.853, abs=1e-3)
    assert margins.plane.rho1_max.value_mm == pytest.approx(28.746, abs=1e-3)
    assert margins.rho3_min_mm == pytest.approx(50 - 10 / math.cos(math.radians(10)))
    assert margins.rho3_max_mm == pytest.approx(margins.rho3_min_mm)


@settings(max_examples=60)
@given(robots(), st.data())
def test_a_box_fits_when_all_of_it_is_reached(geometry: RobotGeometry, data: st.DataObject) -> None:
    extent = tip_slice(geometry, sum(tip_depth_range(geometry)) / 2).extent
    z_min, z_max = tip_depth_range(geometry)
    box = TipBox(
        TipPosition(
            data.draw(between(extent.x_min_mm, extent.x_max_mm)),
            data.draw(between(extent.y_min_mm, extent.y_max_mm)),
            data.draw(between(z_min, z_max)),
        ),
        data.draw(between(0.02, 0.3)) * (extent.x_max_mm - extent.x_min_mm),
        data.draw(between(0.02, 0.3)) * (extent.y_max_mm - extent.y_min_mm),
        data.draw(between(1, 90)),
    )
    margins = tip_box_margins(geometry, box)
    assume(abs(margins.smallest_mm) > 1e-2)
    half = 0.5 * np.array([box.width_mm, box.height_mm, box.depth_mm])
    share = np.linspace(-1, 1, 31)
    offsets = np.stack(np.meshgrid(share, share, share), axis=-1).reshape(-1, 3) * half
    joints = inverse_many(geometry, np.array(box.center) + offsets)
    reached = bool(within_limits_many(geometry, joints).all())
    if margins.fits:
        assert reached
    else:
        # an edge that sticks out between two samples only
        assert not reached or -margins.smallest_mm < (box.height_mm + box.depth_mm) / 30


def test_the_deepest_box_at_the_regular_place_uses_the_whole_slide() -> None:
    found = deepest_box_at(DEFAULT, REGULAR)
    assert found.box.depth_mm == pytest.approx(100 * math.cos(math.radians(10)), abs=1e-8)
    assert found.limited_by == ("rho3_min", "rho3_max")
    assert found.margins.fits
    assert found.box.center == REGULAR.center


def test_a_wide_box_is_limited_by_the_platform() -> None:
    found = deepest_box(DEFAULT, 222, 222)
    assert found.margins.fits
    assert "rho3_min" not in found.limited_by
    assert {"rho1_min", "rho1_max", "rho2_min", "rho2_max"} == set(found.limited_by)
    tall = 222 + (found.box.depth_mm + 1e-6) * math.tan(math.radians(10))
    assert placement_region(DEFAULT, 222, tall).is_empty
    there = deepest_box_at(DEFAULT, found.box)
    assert there.box.depth_mm == pytest.approx(found.box.depth_mm, abs=1e-6)


def test_a_level_slide_asks_nothing_more_of_the_platform() -> None:
    level = DEFAULT.model_copy(update={"theta_rad": 0.0})
    found = deepest_box(level, 200, 200)
    assert found.box.depth_mm == pytest.approx(100)
    assert found.margins.platform.height_mm == 200
    assert tip_depth_range(level) == (200, 300)


def test_boxes_that_fit_nowhere() -> None:
    with pytest.raises(RectangleOutsideError, match="fits nowhere"):
        deepest_box(DEFAULT, 230, 230)
    side = largest_rectangle(DEFAULT).rectangle.width_mm
    assert deepest_box(DEFAULT, side - 1e-3, side - 1e-3).box.depth_mm < 0.1
    aside = TipBox(REGULAR.center._replace(x_mm=700), 200, 200, 20)
    assert not tip_box_margins(DEFAULT, aside).fits
    with pytest.raises(RectangleOutsideError, match="does not reach all of 200 x 200 mm"):
        deepest_box_at(DEFAULT, aside)
    behind = TipBox(REGULAR.center._replace(z_mm=150), 200, 200, 20)
    assert tip_box_margins(DEFAULT, behind).rho3_min_mm < -50
    with pytest.raises(RectangleOutsideError):
        deepest_box_at(DEFAULT, behind)


@pytest.mark.parametrize("depth", [-1.0, math.nan, math.inf])
def test_depths_that_are_none(depth: float) -> None:
    with pytest.raises(InvalidRectangleError):
        TipBox(REGULAR.center, 200, 200, depth)
