from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.camera import pi_camera_v2
from drivers.simulator.driving import DrivingParameters
from drivers.simulator.garage import SimulatedGarage, build_garage
from drivers.simulator.moving_car import CarState, MovingCar
from drivers.simulator.traffic import (
    KEEPS_AWAY_MM,
    Arrival,
    CarWouldHitError,
    NoCarUnderWayError,
    Traffic,
)
from drivers.simulator.world import CarIsPluggedInError
from tests.drivers.simulator.stand import GEOMETRY, HOMED, LIMITS, PERFECT, Stand, on_stand
from twin.camera_mount import CameraMount

NUMBERS = DrivingParameters()
PLACE = np.array([650.0, 300.0, 240.0])
LONGEST_S = 40.0


def a_car(*, right_mm: float = 0.0, heading_rad: float = 0.0, from_mm: float = 3500.0) -> MovingCar:
    start = CarState(
        0.0,
        PLACE[0] + right_mm + NUMBERS.nose_mm * math.sin(heading_rad),
        PLACE[2] + from_mm + NUMBERS.nose_mm * math.cos(heading_rad),
        heading_rad,
    )
    return MovingCar(NUMBERS, PLACE, start, float(PLACE[0]), phase=0.4)


def a_garage() -> SimulatedGarage:
    return build_garage(GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), HOMED, seed=5)


def socket_at(car: MovingCar, t_s: float) -> np.ndarray:
    place = np.append(PLACE, 1.0)
    return np.asarray((car.displacement_at(t_s) @ place)[:3])


def end_of(car: MovingCar, step_s: float = 0.05) -> float:
    t_s = 0.0
    while not car.rests(car.state_at(t_s)) and t_s < LONGEST_S:
        t_s += step_s
    assert t_s < LONGEST_S, "it never stops"
    return t_s


def test_a_car_that_begins_straight_comes_to_its_place_with_the_driver_s_own_unsteadiness() -> None:
    car = a_car()
    car.go(0.0, 3500.0, steer=True)
    found = socket_at(car, end_of(car))
    assert np.abs(found - PLACE).max() < 40.0
    assert np.abs(found - PLACE).max() > 0.01, "nobody drives like a machine"


@settings(max_examples=15, deadline=None)
@given(
    right_mm=st.floats(-250, 250),
    heading_deg=st.floats(-4, 4),
    way_mm=st.floats(600, 3500),
)
def test_motion_keeps_the_limits_of_car_and_driver(
    right_mm: float, heading_deg: float, way_mm: float
) -> None:
    car = a_car(right_mm=right_mm, heading_rad=math.radians(heading_deg))
    car.go(0.0, way_mm, steer=True)
    end_s, step_s = end_of(car), 0.02
    states = [car.state_at(i * step_s) for i in range(int(end_s / step_s))]
    speeds = np.array([s.speed_mm_s for s in states])
    pushes = np.array([s.acceleration_mm_s2 for s in states])
    assert speeds.max() <= NUMBERS.cruise_mm_s * 1.001
    assert np.abs(pushes).max() <= NUMBERS.acceleration_mm_s2 * 1.001
    assert np.abs(np.diff(pushes)).max() <= NUMBERS.jerk_mm_s3 * step_s * 1.05
    assert max(abs(s.curvature_mm) for s in states) <= 1.001 / NUMBERS.least_radius_mm
    axle = np.array([[s.x_mm, s.z_mm] for s in states])
    driven = np.linalg.norm(np.diff(axle, axis=0), axis=1)
    # the rear axle only rolls: its way is along the heading, as long as the wheels turned
    assert driven == pytest.approx(np.abs(np.diff([s.way_mm for s in states])), abs=0.05)
    assert states[-1].way_mm == pytest.approx(way_mm, abs=NUMBERS.creep_mm_s * step_s)


def test_braking_stops_within_what_brakes_allow_and_changes_nothing_before() -> None:
    car = a_car()
    car.go(0.0, 3500.0, steer=True)
    at_s = 3.0
    before = [car.state_at(t) for t in (1.0, 2.5, 2.99)]
    car.state_at(9.0)  # somebody looked ahead
    moving = car.state_at(at_s)
    car.brake(at_s)
    assert [car.state_at(t) for t in (1.0, 2.5, 2.99)] == before
    stopped = car.state_at(end_of(car))
    rolled_mm = stopped.way_mm - moving.way_mm
    v, a, j = moving.speed_mm_s, NUMBERS.brake_mm_s2, NUMBERS.brake_jerk_mm_s3
    assert stopped.speed_mm_s == 0
    assert v * v / (2 * a) < rolled_mm < v * v / (2 * a) + v * a / j + 5.0


def test_the_nose_dips_while_braking_and_swings_when_the_car_has_stopped() -> None:
    car = a_car()
    car.go(0.0, 2000.0, steer=False)
    car.brake(3.0)
    swings = [car.state_at(3.0 + 0.02 * i).pitch_rad for i in range(150)]
    assert max(swings) > 1e-3, "it dips"
    assert min(swings) < -2e-4, "and comes back up beyond its rest"
    still = next(t for t in np.arange(3.0, 8.0, 0.02) if car.state_at(t).speed_mm_s == 0)
    heights = [socket_at(car, still + 0.02 * i)[1] for i in range(50)]
    assert np.ptp(heights) > 0.5, "which a camera sees"


def test_going_on_and_back_leads_to_where_it_was() -> None:
    car = a_car(from_mm=500.0)
    car.go(0.0, 300.0, steer=False)
    first_s = end_of(car)
    there = socket_at(car, first_s)
    car.go(first_s, 50.0, steer=False)
    on_s = first_s + 6.0
    assert socket_at(car, on_s)[2] == pytest.approx(there[2] - 50.0, abs=0.1)
    car.go(on_s, -50.0, steer=False)
    assert socket_at(car, on_s + 6.0) == pytest.approx(there, abs=0.1)


class TestInTheGarage:
    def test_camera_and_truth_see_the_same_car(self) -> None:
        garage = a_garage()
        world, traffic = garage.world, Traffic(garage.world)
        traffic.arrive(Arrival(from_mm=1500.0, right_mm=60.0), 0.0)
        before = None
        for t_s in (0.5, 2.0, 2.1):
            world.advance(t_s)
            view = world.view_at(t_s)
            plug = world.truth().T_base_plug
            T_base_camera = plug @ np.linalg.inv(view.T_camera_plug)
            seen = T_base_camera @ view.T_camera_socket
            assert seen == pytest.approx(world.truth().T_base_socket, abs=1e-6)
            if before is not None and t_s == 2.1:
                moved = view.T_camera_label[:3, 3] - before
                assert moved / 0.1 == pytest.approx(view.label_velocity_mm_s, abs=25.0)
            before = view.T_camera_label[:3, 3]
        assert np.linalg.norm(view.label_velocity_mm_s) > 100.0

    def test_nobody_drives_into_the_plug(self) -> None:
        garage = a_garage()
        traffic = Traffic(garage.world)
        tip_mm = garage.world.truth().T_base_plug[2, 3]
        room_mm = float(garage.world.spot.place[2, 3]) - tip_mm - KEEPS_AWAY_MM
        with pytest.raises(CarWouldHitError):
            traffic.arrive(Arrival(past_mm=room_mm + 1.0), 0.0)
        traffic.arrive(Arrival(from_mm=400.0), 0.0)
        garage.world.advance(20.0)
        with pytest.raises(CarWouldHitError):
            traffic.creep(room_mm + 60.0, 20.0)

    def test_only_a_driver_can_be_told(self) -> None:
        traffic = Traffic(a_garage().world)
        with pytest.raises(NoCarUnderWayError):
            traffic.brake(0.0)
        with pytest.raises(NoCarUnderWayError):
            traffic.creep(10.0, 0.0)
        assert traffic.under_way is None

    def test_a_car_that_leaves_is_gone_and_can_come_back(self) -> None:
        garage = a_garage()
        world, traffic = garage.world, Traffic(garage.world)
        place = world.spot.place[2, 3]
        traffic.leave(0.0)
        world.advance(30.0)
        assert world.car.T_base_socket[2, 3] > place + 5000.0
        traffic.arrive(Arrival(), 30.0)
        world.advance(60.0)
        assert abs(world.car.T_base_socket[2, 3] - place) < 40.0

    def test_a_plugged_in_car_stays(self) -> None:
        async def scenario(stand: Stand) -> None:
            joints = await stand.align()
            await stand.move(joints._replace(rho3_mm=joints.rho3_mm + 30.0), 0.3)
            traffic = Traffic(stand.world)
            for drive in (
                lambda: traffic.arrive(Arrival(), stand.now_s),
                lambda: traffic.leave(stand.now_s),
            ):
                with pytest.raises((CarIsPluggedInError, CarWouldHitError)):
                    drive()
            with pytest.raises(CarIsPluggedInError):
                traffic.leave(stand.now_s)

        on_stand(scenario, PERFECT)
