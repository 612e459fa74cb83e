from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.plant import PlantState
from drivers.simulator.socket_contact import Place
from drivers.simulator.world import SimulatedWorld
from tests.drivers.simulator.stand import GEOMETRY, HOMED, LIMITS, PERFECT, changed
from twin.camera_mount import CameraMount
from twin.joints import JointPosition, TipPosition
from twin.kinematics import alpha, gamma
from twin.motion.discretise import plan_segments
from twin.motion.point_to_point import plan_joint_move


def in_front(
    parameters: SimulationParameters, gap_mm: float, off_mm: float = 0.0
) -> SimulatedWorld:
    """A world whose robot stands in front of the socket of a straight car."""
    world = SimulatedWorld(GEOMETRY, LIMITS, CameraMount(), parameters, 1)
    socket = world.car.T_base_socket
    x, y, z = (socket[:3, 3] - socket[:3, 2] * gap_mm).tolist()
    joints = gamma.inverse(GEOMETRY, TipPosition(x + off_mm, y, z))
    parameters = changed(parameters, "board", start_joints=joints)
    return SimulatedWorld(GEOMETRY, LIMITS, CameraMount(), parameters, 1)


def push_in(world: SimulatedWorld, distance_mm: float, speed: float = 1.0) -> float:
    """Set the set point moving along rho3; returns when it ends."""
    start = world.line.at(0.0).position
    target = start._replace(rho3_mm=start.rho3_mm + distance_mm)
    world.follow(plan_segments(plan_joint_move(LIMITS.scaled(speed), start, target)), 0.0)
    return world.line.rests_from_s


def test_the_plug_goes_in_and_feels_what_the_socket_does() -> None:
    world = in_front(PERFECT, 8.0)
    end_s = push_in(world, 48.0)
    state = world.advance(end_s + 1.0)
    truth = world.truth()
    assert truth.seated
    assert truth.insertion_depth_mm == pytest.approx(40.0, abs=0.02)
    assert truth.max_contact_force_n == pytest.approx(70.0, abs=0.3)
    assert truth.lateral_error_mm == pytest.approx(0.0, abs=0.01)
    assert state.steady
    assert truth.lateral_violation_mm == 0.0


@settings(max_examples=8, deadline=None)
@given(
    st.floats(10.0, 80.0),
    st.floats(0.3, 1.0),
    st.sampled_from([0.0, 0.8, 1.4, 2.5]),
    st.booleans(),
)
def test_the_contact_force_never_exceeds_the_cap(
    cap_n: float, speed: float, off_mm: float, friction: bool
) -> None:
    parameters = changed(PERFECT, "drives", friction_n=2.0 if friction else 0.0)
    world = in_front(parameters, 3.0, off_mm)
    world.set_force_limit(cap_n, 0.0)
    world.advance(push_in(world, 48.0, speed) + 0.5)
    assert world.truth().max_contact_force_n <= cap_n + 0.01


def test_a_cap_below_the_peak_stops_the_plug_on_the_way_in() -> None:
    world = in_front(PERFECT, 4.0)
    world.set_force_limit(40.0, 0.0)
    state = world.advance(push_in(world, 44.0) + 0.5)
    # the socket reaches 40 N a little beyond 30 mm
    assert 30.0 < world.truth().insertion_depth_mm < 32.0
    assert state.contact.force_n == pytest.approx(40.0, abs=0.1)
    assert state.blocked_for_s > 0.5
    assert world.measured_force_n(state) == pytest.approx(40.0)


def test_a_plug_beside_the_opening_stops_at_the_panel() -> None:
    world = in_front(PERFECT, 4.0, off_mm=2.0)
    world.set_force_limit(60.0, 0.0)
    world.advance(push_in(world, 44.0) + 0.5)
    truth = world.truth()
    assert truth.jammed
    assert not truth.seated
    assert truth.insertion_depth_mm == pytest.approx(60.0 / 150.0, abs=0.01)
    assert truth.lateral_error_mm == pytest.approx(2.0, abs=0.01)


def test_a_raised_cap_lets_the_plug_go_on() -> None:
    world = in_front(PERFECT, 4.0)
    world.set_force_limit(40.0, 0.0)
    end_s = push_in(world, 44.0)
    world.advance(end_s + 1.0)
    world.set_force_limit(100.0, end_s + 1.0)
    world.advance(end_s + 2.0)
    assert world.truth().seated


def test_moving_sideways_with_the_plug_in_is_written_down() -> None:
    world = in_front(PERFECT, 4.0)
    end_s = push_in(world, 44.0)
    world.advance(end_s + 0.5)
    start = world.line.at(end_s + 0.5).position
    v = gamma.platform(GEOMETRY, start)
    rho1, rho2 = alpha.inverse(GEOMETRY, v._replace(x_mm=v.x_mm + 0.7))
    plan = plan_joint_move(LIMITS, start, JointPosition(rho1, rho2, start.rho3_mm))
    world.follow(plan_segments(plan), end_s + 0.5)
    world.advance(end_s + 2.0)
    assert world.truth().lateral_violation_mm == pytest.approx(0.7, abs=0.02)


@settings(max_examples=6, deadline=None)
@given(st.lists(st.floats(0.0, 6.0), min_size=1, max_size=12))
def test_asking_more_often_does_not_change_what_happens(times: list[float]) -> None:
    once, often = in_front(HOMED, 5.0), in_front(HOMED, 5.0)
    push_in(once, 45.0)
    push_in(often, 45.0)
    for t_s in sorted(times):
        often.advance(t_s)
    expected, state = once.advance(7.0), often.advance(7.0)
    assert state.carriages == pytest.approx(expected.carriages, abs=1e-4)
    assert state.contact.force_n == pytest.approx(expected.contact.force_n, abs=0.5)
    assert state.max_force_n == pytest.approx(expected.max_force_n, abs=0.5)


def test_looking_ahead_and_back_changes_nothing() -> None:
    world, other = in_front(HOMED, 5.0), in_front(HOMED, 5.0)
    push_in(world, 45.0)
    push_in(other, 45.0)
    for i in range(300):
        t_s = 0.02 * i
        world.view_at(max(t_s - 0.05, 0.0))
        world.advance(t_s)
        other.advance(t_s)
        world.view_at(t_s + 0.02)
    assert world.advance(7.0) == other.advance(7.0)


def test_the_carriages_lag_by_half_the_play_behind_their_motors() -> None:
    parameters = changed(PERFECT, "drives", backlash_mm=(0.06, 0.04, 0.05))
    world = SimulatedWorld(GEOMETRY, LIMITS, CameraMount(), parameters, 1)

    def go(to: JointPosition, at_s: float) -> PlantState:
        start = world.line.at(at_s).position
        world.follow(plan_segments(plan_joint_move(LIMITS, start, to)), at_s)
        return world.advance(at_s + 5.0)

    forth = go(JointPosition(160.0, 170.0, 60.0), 0.0)
    lag = [m - c for m, c in zip(forth.motors, forth.carriages, strict=True)]
    assert lag == pytest.approx((0.03, 0.02, 0.025), abs=1e-4)
    back = go(JointPosition(155.0, 160.0, 55.0), 5.0)
    lag = [m - c for m, c in zip(back.motors, back.carriages, strict=True)]
    assert lag == pytest.approx((-0.03, -0.02, -0.025), abs=1e-4)


def test_the_robot_sags_by_about_a_millimetre() -> None:
    rigid = SimulatedWorld(GEOMETRY, LIMITS, CameraMount(), PERFECT, 1)
    soft_parameters = changed(PERFECT, "build", sag_scale=1.0)
    soft = SimulatedWorld(GEOMETRY, LIMITS, CameraMount(), soft_parameters, 1)
    drop = rigid.truth().T_base_plug[:3, 3] - soft.truth().T_base_plug[:3, 3]
    # the platform by about 1 mm, and the drawn-back plug by the most of the second table
    beta_mean = (1.080 + 0.996 + 0.936 + 0.907 + 0.958) / 5
    assert drop[1] == pytest.approx(0.99 + 1.080 - beta_mean, abs=0.02)
    assert drop[0] == drop[2] == 0.0


def test_a_plug_in_front_of_the_socket_is_free() -> None:
    world = in_front(PERFECT, 4.0)
    state = world.advance(push_in(world, 3.9) + 1.0)
    assert state.contact.place is Place.FREE
    assert state.max_force_n == 0.0
