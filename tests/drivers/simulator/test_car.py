from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulator.car import ParkedCar, park
from drivers.simulator.parameters import CarParameters, ContactParameters, SimulationParameters
from tests.drivers.simulator.stand import GEOMETRY
from twin.joints import TipPosition
from twin.kinematics import gamma

seeds = st.integers(0, 2**32 - 1)


def parked(seed: int, car: CarParameters | None = None) -> ParkedCar:
    return park(GEOMETRY, car or CarParameters(), ContactParameters(), np.random.default_rng(seed))


@given(seeds)
def test_the_nominal_robot_reaches_every_socket_over_the_whole_depth(seed: int) -> None:
    pose = parked(seed).T_base_socket
    for depth_mm in (-20.0, 0.0, 40.0):
        # along its own axis, which is what it can do
        tip = pose[:3, 3] + np.array(GEOMETRY.insertion_axis) * depth_mm
        gamma.inverse(GEOMETRY, TipPosition(*tip))


@given(seeds)
def test_the_platform_faces_the_socket_within_the_regular_box(seed: int) -> None:
    face = TipPosition(*parked(seed).T_base_socket[:3, 3])
    v, rho3_mm = gamma.platform_for_tip(GEOMETRY, face)
    assert abs(v.x_mm - 650.0) <= 100.0
    assert abs(v.y_mm - 335.0) <= 100.0 + 1e-9
    assert 230.0 <= face.z_mm <= 250.0
    assert gamma.tip_offset(GEOMETRY, rho3_mm)[1] == pytest.approx(face.z_mm)


def test_cars_fill_the_whole_box() -> None:
    faces = np.array([parked(seed).T_base_socket[:3, 3] for seed in range(400)])
    spread = faces.max(axis=0) - faces.min(axis=0)
    assert spread[0] > 190
    assert spread[1] > 190
    assert spread[2] > 19


@given(seeds)
def test_socket_and_label_are_rigid_and_tilted_at_most_two_degrees_per_axis(seed: int) -> None:
    car = parked(seed)
    for pose in (car.T_base_label, car.T_base_socket):
        rotation = pose[:3, :3]
        assert rotation.T @ rotation == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1.0)
    cosine = float(car.T_base_socket[:3, 2] @ np.array(GEOMETRY.insertion_axis))
    assert math.degrees(math.acos(min(cosine, 1.0))) <= math.hypot(2.0, 2.0) + 1e-6


@given(seeds)
def test_the_known_offset_leads_from_the_label_to_the_socket(seed: int) -> None:
    car = parked(seed, CarParameters(knowledge_std_mm=0.0, sticking_angle_std_rad=0.02))
    known = car.known_offset
    label_socket = np.linalg.inv(car.T_base_label) @ car.T_base_socket
    assert label_socket[:3, 3] == pytest.approx((known.x_mm, known.y_mm, known.z_mm), abs=1e-9)
    # first about the label's x, then about its y
    a, b = known.rotation_x_rad, known.rotation_y_rad
    axis = np.array([0.0, -math.sin(a), math.cos(a)])
    axis = np.array([axis[2] * math.sin(b), axis[1], axis[2] * math.cos(b)])
    assert label_socket[:3, 2] == pytest.approx(axis, abs=1e-12)


def test_what_is_known_of_the_offset_is_off_by_its_standard_deviation() -> None:
    errors = []
    for seed in range(300):
        car = parked(seed)
        true = (np.linalg.inv(car.T_base_label) @ car.T_base_socket)[:3, 3]
        known = car.known_offset
        errors.append(true - (known.x_mm, known.y_mm, known.z_mm))
    assert np.std(errors) == pytest.approx(0.05, rel=0.1)
    assert abs(np.mean(errors)) < 0.01


def test_a_car_parked_straight_has_its_label_beside_the_socket() -> None:
    car = parked(3, SimulationParameters.perfect().car)
    way = car.T_base_label[:3, 3] - car.T_base_socket[:3, 3]
    # the socket is to the right of the label, and right is against the base's x
    assert way == pytest.approx((120.0, 0.0, 0.0))
    assert car.T_base_label[:3, 0] == pytest.approx((-1.0, 0.0, 0.0))
    assert car.T_base_label[:3, 1] @ (0.0, -1.0, 0.0) > 0.9
    assert car.T_base_label[:3, 2] == pytest.approx(GEOMETRY.insertion_axis)


def test_the_seed_decides() -> None:
    assert np.array_equal(parked(5).T_base_label, parked(5).T_base_label)
    assert not np.array_equal(parked(5).T_base_label, parked(6).T_base_label)


def test_a_car_has_room_in_its_battery() -> None:
    wanted = [parked(seed).wanted_wh for seed in range(200)]
    assert min(wanted) >= 0.2 * 52_000 - 1e-6
    assert max(wanted) <= 0.5 * 52_000 + 1e-6
