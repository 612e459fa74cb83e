from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from server.config.settings import Settings
from server.guidance.reach import Interval, Reach
from server.jobs.approach import pre_insertion
from server.localisation.errors import SocketUnreachableError
from server.localisation.socket_pose import SocketPose
from tests.server.guidance.cars import REACH, SETTINGS
from twin.geometry import RegularBox
from twin.joints import TipPosition
from twin.kinematics import KinematicsError, gamma

GEOMETRY, INSERTION, GUIDANCE = SETTINGS.geometry, SETTINGS.insertion, SETTINGS.guidance
SURE = np.zeros((3, 3))

places = st.tuples(st.floats(400, 900), st.floats(-60, 600), st.floats(180, 300)).map(np.array)


def a_job_could_plug_in(place_mm: np.ndarray) -> bool:
    """By the very check that a charging job makes."""
    pose = np.eye(4)
    pose[:3, 3] = place_mm
    pose[:3, 2] = GEOMETRY.insertion_axis
    socket = SocketPose(pose, pose, np.eye(3), 0.0)
    try:
        pre_insertion(GEOMETRY, socket, INSERTION)
    except SocketUnreachableError:
        return False
    return True


def along_the_way(place_mm: np.ndarray) -> list[np.ndarray]:
    axis = np.array(GEOMETRY.insertion_axis)
    depths = np.linspace(-INSERTION.pre_insertion_distance_mm, INSERTION.depth_mm, 7)
    return [place_mm + depth * axis for depth in depths]


@settings(max_examples=400, deadline=None)
@given(place=places)
def test_reachable_is_what_a_job_calls_reachable(place: np.ndarray) -> None:
    margin_mm = REACH.standing(REACH.reachable, place, SURE).margin_mm
    if abs(margin_mm) > 1e-6:
        assert (margin_mm > 0) is a_job_could_plug_in(place)


@settings(max_examples=200, deadline=None)
@given(place=places)
def test_good_leaves_the_margin_on_the_whole_way_of_the_plug(place: np.ndarray) -> None:
    """Every tip position of the way, shifted by the margin to each side, is reached."""
    if REACH.standing(REACH.good, place, SURE).margin_mm < 0:
        return
    m, slide_mm = GUIDANCE.margin_mm, GUIDANCE.depth_margin_mm
    axis = np.array(GEOMETRY.insertion_axis)
    for tip in along_the_way(place):
        for right, up, on in itertools.product((-1, 1), (-1, 1), (-1, 1)):
            shifted = tip + np.array([right * m, up * m, 0.0]) + on * slide_mm * axis
            gamma.inverse(GEOMETRY, TipPosition(*shifted.tolist()))  # raises where it is not
    platform, _ = gamma.platform_for_tip(GEOMETRY, TipPosition(*place.tolist()))
    box = GEOMETRY.regular_box
    assert abs(platform.x_mm - box.center_x_mm) <= box.width_mm / 2 - m + 1e-9
    assert abs(platform.y_mm - box.center_y_mm) <= box.height_mm / 2 - m + 1e-9


@settings(max_examples=200, deadline=None)
@given(place=places)
def test_the_way_that_is_given_leads_into_the_zone(place: np.ndarray) -> None:
    for zone in (REACH.good, REACH.reachable):
        standing = REACH.standing(zone, place, SURE)
        # depth first, then height: V's height follows from where the car will stand
        moved = place + np.array([standing.to_x_mm, standing.to_y_mm, standing.to_z_mm])
        assert REACH.standing(zone, moved, SURE).margin_mm > -1e-6


@settings(max_examples=100, deadline=None)
@given(place=places, sigma_mm=st.floats(0.1, 20))
def test_doubt_takes_margin_away(place: np.ndarray, sigma_mm: float) -> None:
    sure = REACH.standing(REACH.good, place, SURE)
    unsure = REACH.standing(REACH.good, place, sigma_mm**2 * np.eye(3))
    least = GUIDANCE.certainty * sigma_mm
    assert sure.margin_mm - unsure.margin_mm >= least * 0.999
    assert sure.margin_mm - unsure.margin_mm <= least / math.cos(GEOMETRY.theta_rad) * 1.001
    assert (unsure.to_x_mm, unsure.to_z_mm) == (sure.to_x_mm, sure.to_z_mm)


def test_the_best_place_is_good_by_all_that_the_depth_leaves() -> None:
    place = np.array([GEOMETRY.regular_box.center_x_mm, REACH.middle_y_mm, REACH.stop_z_mm])
    standing = REACH.standing(REACH.good, place, SURE)
    depth = REACH.good.depth
    assert standing.margin_mm == pytest.approx((depth.high_mm - depth.low_mm) / 2)
    slide = GEOMETRY.rho3.stroke_mm - INSERTION.depth_mm - INSERTION.pre_insertion_distance_mm
    expected = (slide - 2 * GUIDANCE.depth_margin_mm) * math.cos(GEOMETRY.theta_rad)
    assert depth.high_mm - depth.low_mm == pytest.approx(expected)


def test_the_outline_runs_along_the_edge_of_the_zone() -> None:
    for zone in (REACH.good, REACH.reachable):
        for x, z in REACH.outline(zone, REACH.middle_y_mm):
            place = np.array([x, REACH.middle_y_mm, z])
            assert REACH.standing(zone, place, SURE).margin_mm == pytest.approx(0.0, abs=1e-6)


def test_a_robot_without_any_margin_has_only_its_reach() -> None:
    guidance = GUIDANCE.model_copy(update={"margin_mm": 80.0})
    tiny = GEOMETRY.model_copy(
        update={
            "rho1": GEOMETRY.rho1.model_copy(update={"max_mm": 300.0}),
            "rho2": GEOMETRY.rho2.model_copy(update={"max_mm": 300.0}),
        }
    )
    reach = Reach(tiny, INSERTION, guidance)
    assert reach.good.depth.low_mm <= reach.stop_z_mm <= reach.good.depth.high_mm
    place = np.array([650.0, reach.middle_y_mm, reach.stop_z_mm])
    with pytest.raises(KinematicsError):
        gamma.inverse(tiny, TipPosition(650.0, 2000.0, 240.0))
    assert math.isfinite(reach.standing(reach.good, place, SURE).margin_mm)


def test_a_box_beside_the_reach_never_promises_more_than_the_reach() -> None:
    box = RegularBox(center_x_mm=900.0, width_mm=200.0)
    settings_ = Settings(geometry=GEOMETRY.model_copy(update={"regular_box": box}))
    reach = Reach(settings_.geometry, INSERTION, GUIDANCE)
    for x in np.linspace(500, 1000, 26):
        place = np.array([x, reach.middle_y_mm, reach.stop_z_mm])
        if reach.standing(reach.good, place, SURE).margin_mm > 1e-6:
            assert a_job_could_plug_in(place)


def test_intervals() -> None:
    interval = Interval(2.0, 6.0)
    assert (interval.margin_mm(3.0), interval.margin_mm(7.0)) == (1.0, -1.0)
    assert (interval.way_mm(0.0), interval.way_mm(5.0), interval.way_mm(8.0)) == (2.0, 0.0, -2.0)
    assert interval.shrunk(1.0) == Interval(3.0, 5.0)
    assert interval.shrunk(99.0) == Interval(4.0, 4.0)
