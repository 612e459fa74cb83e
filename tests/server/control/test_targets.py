"""Going to a place that somebody has pointed at: seen first, held to go, checked as any motion."""

from __future__ import annotations

import asyncio
import math

import pytest

from server.control.errors import (
    ActuatorOverloadError,
    ControlBusyError,
    ControlError,
    LateralMotionForbiddenError,
    MotionOutOfReachError,
    RobotNotReadyError,
    TargetGoneError,
)
from server.control.model import PlugState, RobotMode
from server.control.plug_guard import PlugRecord
from server.control.targets import Target, Targets
from tests.support.robot_cell import GEOMETRY, MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import wait_until
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma

MIDDLE = JointPosition(200.0, 180.0, 80.0)
STANDING = parameters(start_joints=MIDDLE)
SPEED_MM_S = 20.0


def targets_of(cell: RobotCell) -> Targets:
    return Targets(cell.supervisor, cell.jog)


def tip(cell: RobotCell) -> TipPosition:
    return gamma.forward(GEOMETRY, cell.now)


async def choose_beside(cell: RobotCell, targets: Targets, dx_mm: float, dy_mm: float) -> Target:
    here = tip(cell)
    return await targets.choose(here.x_mm + dx_mm, here.y_mm + dy_mm, SPEED_MM_S)


async def hold_for(targets: Targets, target: Target, duration_s: float) -> None:
    for _ in range(round(duration_s / 0.1)):
        targets.hold(target.id)
        await asyncio.sleep(0.1)


def test_choosing_moves_nothing_and_needs_no_control() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets, before = targets_of(cell), cell.now
        target = await choose_beside(cell, targets, 40.0, 20.0)
        await asyncio.sleep(2.0)
        assert math.dist(cell.now, before) < 0.01
        assert cell.holder() is None
        assert targets.target is target
        assert target.plan.start.position == cell.robot.commanded.position
        assert target.plan.duration_s > math.hypot(40, 20) / SPEED_MM_S

    in_cell(scenario, STANDING)


def test_holding_goes_straight_there_and_the_target_is_done_then() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets, began = targets_of(cell), tip(cell)
        target = await choose_beside(cell, targets, 30.0, 15.0)
        while targets.target is not None:
            targets.hold(target.id)
            here = tip(cell)
            off_line_mm = abs((here.y_mm - began.y_mm) - 0.5 * (here.x_mm - began.x_mm))
            assert off_line_mm < 0.1
            await asyncio.sleep(0.1)
        await cell.jog.wait_stopped()
        there = tip(cell)
        assert there.x_mm - began.x_mm == pytest.approx(30.0, abs=0.05)
        assert there.y_mm - began.y_mm == pytest.approx(15.0, abs=0.05)
        assert there.z_mm == pytest.approx(began.z_mm, abs=0.05)
        assert cell.holder() is None
        with pytest.raises(TargetGoneError):
            targets.hold(target.id)

    in_cell(scenario, STANDING)


def test_letting_go_and_silence_stop_on_the_way() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        target = await choose_beside(cell, targets, 60.0, 0.0)
        await hold_for(targets, target, 1.0)
        assert cell.moving()
        assert await wait_until(lambda: not cell.moving()) < 0.25  # nobody has said anything
        await cell.jog.wait_stopped()
        assert cell.mode() is RobotMode.READY, "nothing is latched"
        assert targets.target is None, "the way began elsewhere"

    in_cell(scenario, STANDING)


@pytest.mark.parametrize("after_s", [0.0, 0.01, 0.03, 0.05, 0.08])
def test_who_lets_go_may_ask_for_the_rest_of_the_way_at_once(after_s: float) -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        target = await choose_beside(cell, targets, 60.0, 0.0)
        await hold_for(targets, target, 1.0)
        cell.jog.release()
        await asyncio.sleep(after_s)
        rest = await choose_beside(cell, targets, 20.0, 0.0)
        assert cell.mode() is RobotMode.READY
        targets.hold(rest.id)
        await asyncio.sleep(0.2)
        assert cell.moving(), "the board has taken the plan"

    in_cell(scenario, STANDING)


def test_no_way_is_planned_for_a_robot_that_somebody_else_moves() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        cell.jog.hold("x", 1, SPEED_MM_S)
        await asyncio.sleep(0.15)
        assert cell.moving()
        with pytest.raises(RobotNotReadyError, match="moving"):
            await choose_beside(cell, targets, 20.0, 0.0)

    in_cell(scenario, STANDING)


def test_somebody_else_in_control_is_respected() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        target = await choose_beside(cell, targets, 20.0, 0.0)
        async with cell.supervisor.control("job", "Charging job"):
            with pytest.raises(ControlBusyError, match="Charging job"):
                targets.hold(target.id)
        assert not cell.moving()

    in_cell(scenario, STANDING)


@pytest.mark.parametrize(("dx_mm", "dy_mm"), [(5000.0, 0.0), (0.0, -400.0), (0.0, 900.0)])
def test_what_is_out_of_reach_is_no_target(dx_mm: float, dy_mm: float) -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        with pytest.raises((MotionOutOfReachError, ActuatorOverloadError)):
            await choose_beside(cell, targets, dx_mm, dy_mm)
        assert targets.target is None

    in_cell(scenario, STANDING)


def test_a_plug_that_may_be_in_a_socket_forbids_every_place() -> None:
    async def scenario(cell: RobotCell) -> None:
        assert cell.plug() is PlugState.UNKNOWN
        with pytest.raises(LateralMotionForbiddenError):
            await choose_beside(cell, targets_of(cell), 10.0, 0.0)

    in_cell(scenario, STANDING, store=MemoryPlug(PlugRecord(PlugState.UNKNOWN, None)))


def test_the_plug_is_looked_at_again_when_the_motion_begins() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        target = await choose_beside(cell, targets, 10.0, 0.0)
        cell.supervisor.plug._record = PlugRecord(PlugState.UNKNOWN, None)
        with pytest.raises(LateralMotionForbiddenError):
            targets.hold(target.id)
        assert cell.holder() is None

    in_cell(scenario, STANDING)


def test_a_robot_that_is_not_ready_has_no_way() -> None:
    async def scenario(cell: RobotCell) -> None:
        with pytest.raises(RobotNotReadyError):
            await targets_of(cell).choose(600.0, 300.0, SPEED_MM_S)

    in_cell(scenario, STANDING, enabled=False)


def test_a_motion_from_elsewhere_and_another_choice_end_a_target() -> None:
    async def scenario(cell: RobotCell) -> None:
        targets = targets_of(cell)
        told: list[Target | None] = []
        targets.listen(lambda: told.append(targets.target))
        first = await choose_beside(cell, targets, 10.0, 0.0)
        second = await choose_beside(cell, targets, 0.0, 10.0)
        with pytest.raises(TargetGoneError):
            targets.hold(first.id)
        await cell.jog.step("rho1", 1.0, 10.0)
        assert targets.target is None
        with pytest.raises(ControlError):
            targets.hold(second.id)
        await choose_beside(cell, targets, 5.0, 0.0)
        targets.forget()
        assert told[0] is first
        assert told[1] is second
        assert told[-1] is None

    in_cell(scenario, STANDING)
