"""Plans that ask an actuator for more than it can hold."""

from __future__ import annotations

import pytest

from server.control.errors import ActuatorOverloadError
from server.control.model import PlugState
from server.control.path_check import Strength, check_path
from server.control.plug_guard import PlugGuard, PlugRecord
from tests.support.robot_cell import MemoryPlug
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.kinematics.alpha import PlatformPosition
from twin.motion import JointState, MotionLimits, MotionPlan, plan_joint_move
from twin.statics import ActuatorLimits, LoadCase, Loads, actuator_loads

GEOMETRY = RobotGeometry()
LOADS = Loads()


def pose(y_mm: float, rho3_mm: float = 60.0) -> JointPosition:
    return JointPosition(*alpha.inverse(GEOMETRY, PlatformPosition(650.0, y_mm)), rho3_mm)


def plan(start: JointPosition, end: JointPosition) -> MotionPlan:
    return plan_joint_move(MotionLimits(), JointState.at_rest(start), end)


async def guard(state: PlugState) -> PlugGuard:
    store = MemoryPlug()
    await store.save(PlugRecord(state, None))
    plug = PlugGuard(store, lambda: None)
    await plug.recover()
    return plug


def holding_n(y_mm: float) -> float:
    return actuator_loads(GEOMETRY, pose(y_mm), LOADS, LoadCase.HOLDING).rho1_n


async def test_a_way_down_to_where_the_legs_are_too_flat_is_refused_with_place_and_excess() -> None:
    weak = Strength(LOADS, ActuatorLimits(rho1_n=holding_n(240.0), rho2_n=500.0))
    plug = await guard(PlugState.FREE)
    check_path(GEOMETRY, plug, plan(pose(400.0), pose(245.0)), weak)
    with pytest.raises(ActuatorOverloadError, match="left carriage would have to hold") as caught:
        check_path(GEOMETRY, plug, plan(pose(400.0), pose(220.0)), weak)
    facts = caught.value.context
    assert facts["joint"] == "rho1"
    assert facts["y_mm"] == pytest.approx(220, abs=0.1)
    assert facts["x_mm"] == pytest.approx(650, abs=0.1)
    assert facts["excess_n"] == pytest.approx(holding_n(220) - holding_n(240), abs=0.1)
    assert "5 N more than its" in caught.value.detail
    assert "x = 650 mm, y = 220 mm" in caught.value.detail
    assert facts["time_s"] > 0


async def test_the_way_up_from_where_it_hangs_too_low_is_allowed() -> None:
    weak = Strength(LOADS, ActuatorLimits(rho1_n=holding_n(300.0), rho2_n=holding_n(300.0)))
    plug = await guard(PlugState.FREE)
    check_path(GEOMETRY, plug, plan(pose(220.0), pose(400.0)), weak)
    with pytest.raises(ActuatorOverloadError):
        check_path(GEOMETRY, plug, plan(pose(220.0), pose(219.0)), weak)


async def test_a_plug_goes_in_only_where_it_can_be_drawn_out_again() -> None:
    weight = LOADS.on_slide_kg * 9.80665 * 0.17365
    plug = await guard(PlugState.FREE)
    inwards = plan(pose(335.0, 60.0), pose(335.0, 120.0))
    enough = Strength(LOADS, ActuatorLimits(rho3_n=70 + weight + 0.1))
    check_path(GEOMETRY, plug, inwards, enough)
    little = Strength(LOADS, ActuatorLimits(rho3_n=70 + weight - 0.1))
    with pytest.raises(ActuatorOverloadError, match="slide would have to hold 73 N while withdraw"):
        check_path(GEOMETRY, plug, inwards, little)


async def test_the_way_out_of_a_socket_is_never_refused_for_its_forces() -> None:
    nothing = Strength(LOADS, ActuatorLimits(rho1_n=1, rho2_n=1, rho3_n=1))
    plug = await guard(PlugState.UNKNOWN)
    check_path(GEOMETRY, plug, plan(pose(335.0, 120.0), pose(335.0, 60.0)), nothing)
