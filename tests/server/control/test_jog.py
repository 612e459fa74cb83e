from __future__ import annotations

import asyncio
from typing import get_args

import numpy as np
import pytest

from server.control.errors import (
    ControlBusyError,
    LateralMotionForbiddenError,
    MotionOutOfReachError,
    RobotFaultError,
    RobotNotReadyError,
)
from server.control.jog import Axis
from server.control.model import PlugState, RobotMode
from server.control.plug_guard import Corridor, PlugRecord
from tests.support.robot_cell import AWAY, GEOMETRY, MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import wait_until
from twin.joints import JointPosition
from twin.kinematics import gamma

MIDDLE = JointPosition(200.0, 180.0, 80.0)
STANDING = parameters(start_joints=MIDDLE)


async def keep_holding(cell: RobotCell, axis: Axis, direction: int, duration_s: float) -> None:
    """As a page does: a message every 100 ms."""
    for _ in range(round(duration_s / 0.1)):
        cell.jog.hold(axis, direction, 40.0)
        await asyncio.sleep(0.1)


def test_a_held_button_moves_and_its_release_stops() -> None:
    async def scenario(cell: RobotCell) -> None:
        before = gamma.forward(GEOMETRY, cell.now)
        await keep_holding(cell, "x", 1, 1.0)
        assert cell.moving()
        holder = cell.holder()
        assert holder is not None
        assert holder.kind == "jog"
        cell.jog.release()
        assert await wait_until(lambda: not cell.moving()) < 0.06
        await cell.jog.wait_stopped()
        assert cell.holder() is None
        after = gamma.forward(GEOMETRY, cell.now)
        assert 30.0 < after.x_mm - before.x_mm < 45.0
        assert after.y_mm == pytest.approx(before.y_mm, abs=0.05)
        assert after.z_mm == pytest.approx(before.z_mm, abs=0.05)

    in_cell(scenario, STANDING)


def test_silence_stops_like_a_released_button() -> None:
    async def scenario(cell: RobotCell) -> None:
        await keep_holding(cell, "rho1", 1, 1.0)  # the last message came 0.1 s ago
        assert await wait_until(lambda: not cell.moving()) == pytest.approx(0.15 + 0.03, abs=0.03)
        await cell.jog.wait_stopped()
        assert cell.holder() is None
        assert cell.mode() is RobotMode.READY, "nothing is latched"
        await keep_holding(cell, "rho1", -1, 0.5)
        assert cell.moving()

    in_cell(scenario, STANDING)


def test_another_direction_stops_first_and_then_goes_back() -> None:
    async def scenario(cell: RobotCell) -> None:
        await keep_holding(cell, "x", 1, 0.6)
        turning = cell.now
        cell.jog.hold("x", -1, 40.0)
        await wait_until(lambda: not cell.moving())
        furthest = cell.now
        assert furthest.rho1_mm > turning.rho1_mm
        await keep_holding(cell, "x", -1, 0.6)
        assert cell.now.rho1_mm < furthest.rho1_mm - 5.0
        cell.jog.release()
        cell.jog.release()
        await cell.jog.wait_stopped()
        assert cell.holder() is None

    in_cell(scenario, STANDING)


def test_a_button_that_is_only_tapped_gives_the_lease_back() -> None:
    """The task that moves is cancelled before its first step."""

    async def scenario(cell: RobotCell) -> None:
        cell.jog.hold("y", 1, 40.0)
        cell.jog.release()
        await cell.jog.wait_stopped()
        await asyncio.sleep(0)
        assert cell.holder() is None
        assert not cell.moving()
        await cell.jog.step("y", 1.0, 20.0)

    in_cell(scenario, STANDING)


def test_while_a_job_has_control_nobody_jogs() -> None:
    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("job", "Charging job"):
            with pytest.raises(ControlBusyError, match="Charging job"):
                cell.jog.hold("x", 1, 40.0)
            with pytest.raises(ControlBusyError, match="Charging job"):
                await cell.jog.step("x", 1.0, 40.0)
            assert not cell.moving()
        cell.jog.hold("x", 1, 40.0)
        with pytest.raises(ControlBusyError, match="technician"):
            cell.supervisor.acquire("job", "Charging job")

    in_cell(scenario, STANDING)


@pytest.mark.parametrize("axis", get_args(Axis))
@pytest.mark.parametrize("direction", [-1, 1])
def test_every_axis_can_be_held_to_the_end_of_its_travel_and_no_further(
    axis: Axis, direction: int
) -> None:
    async def scenario(cell: RobotCell) -> None:
        cell.garage.world.remove_car()
        start = cell.now
        with pytest.raises(MotionOutOfReachError):
            await keep_holding(cell, axis, direction, 30.0)
        assert cell.holder() is None
        assert cell.supervisor.fault is None
        moved = max(abs(a - b) for a, b in zip(cell.now, start, strict=True))
        assert moved > 20.0
        assert gamma.within_limits_many(GEOMETRY, np.array([cell.now]))[0]

    in_cell(scenario, STANDING)


def test_what_is_left_of_each_axis_is_told_before_it_is_reached() -> None:
    async def scenario(cell: RobotCell) -> None:
        cell.garage.world.remove_car()
        ways = cell.jog.ways_left_mm()
        assert set(ways) == set(get_args(Axis))
        start = gamma.forward(GEOMETRY, cell.now)
        with pytest.raises(MotionOutOfReachError):
            await keep_holding(cell, "x", 1, 30.0)
        end = gamma.forward(GEOMETRY, cell.now)
        assert end.x_mm - start.x_mm == pytest.approx(ways["x"][1], abs=1.0)
        left = cell.jog.ways_left_mm()["x"]
        assert left[1] < 1.0
        assert left[0] == pytest.approx(ways["x"][0] + ways["x"][1], abs=2.0)

    in_cell(scenario, STANDING)


def test_a_step_goes_as_far_as_asked_and_not_beyond_the_limits() -> None:
    async def scenario(cell: RobotCell) -> None:
        before = gamma.forward(GEOMETRY, cell.now)
        began_s = asyncio.get_running_loop().time()
        await cell.jog.step("y", -12.5, 20.0)
        assert asyncio.get_running_loop().time() - began_s > 12.5 / 20.0
        after = gamma.forward(GEOMETRY, cell.now)
        assert after.y_mm - before.y_mm == pytest.approx(-12.5, abs=0.05)
        assert after.x_mm == pytest.approx(before.x_mm, abs=0.05)
        here = cell.now
        for axis, distance_mm in (("rho3", 80.0), ("x", 5000.0), ("rho1", -400.0)):
            with pytest.raises(MotionOutOfReachError):
                await cell.jog.step(axis, distance_mm, 20.0)  # type: ignore[arg-type]  # an Axis
            assert cell.holder() is None
        assert cell.now == here

    in_cell(scenario, STANDING)


@pytest.mark.parametrize("state", [PlugState.INSERTED, PlugState.UNKNOWN])
def test_with_the_plug_in_a_socket_only_the_way_out_can_be_jogged(state: PlugState) -> None:
    async def scenario(cell: RobotCell) -> None:
        for axis in get_args(Axis):
            for direction in (-1, 1):
                if axis in {"rho3", "insertion"} and direction == -1:
                    continue
                with pytest.raises(LateralMotionForbiddenError):
                    cell.jog.hold(axis, direction, 40.0)
                with pytest.raises(LateralMotionForbiddenError):
                    await cell.jog.step(axis, 0.5 * direction, 40.0)
        assert cell.now == pytest.approx(MIDDLE, abs=0.01)
        await cell.jog.step("rho1", 0.04, 40.0)
        with pytest.raises(LateralMotionForbiddenError):
            await cell.jog.step("rho1", 0.04, 40.0)
        assert abs(cell.now.rho1_mm - MIDDLE.rho1_mm) <= 0.05, "small steps must not add up"
        await keep_holding(cell, "insertion", -1, 1.0)
        cell.jog.release()
        await cell.jog.wait_stopped()
        assert cell.now.rho3_mm < MIDDLE.rho3_mm - 5.0

    corridor = Corridor(200.0, 180.0, 55.0, 60.0, 100.0) if state is PlugState.INSERTED else None
    in_cell(scenario, STANDING, store=MemoryPlug(PlugRecord(state, corridor)))


def test_a_fault_ends_the_motion_and_is_told_at_the_next_message() -> None:
    async def scenario(cell: RobotCell) -> None:
        await keep_holding(cell, "x", 1, 0.5)
        cell.garage.robot.trip_limit(0)
        await asyncio.sleep(0.1)
        await cell.jog.wait_stopped()
        assert cell.holder() is None
        with pytest.raises(RobotFaultError):
            cell.jog.hold("x", 1, 40.0)
        assert cell.holder() is None

    in_cell(scenario, STANDING)


def test_a_step_whose_caller_goes_away_halts() -> None:
    async def scenario(cell: RobotCell) -> None:
        step = asyncio.create_task(cell.jog.step("x", 100.0, 40.0))
        await asyncio.sleep(0.5)
        assert cell.moving()
        step.cancel()
        await asyncio.wait([step])
        assert not cell.moving()
        assert cell.holder() is None
        assert cell.now != pytest.approx(AWAY)

    in_cell(scenario, STANDING)


def test_a_plug_that_was_jogged_against_something_may_be_in_a_socket() -> None:
    async def scenario(cell: RobotCell) -> None:
        cell.garage.robot.jam()
        cell.jog.hold("insertion", 1, 40.0)
        await asyncio.sleep(0.24)
        await wait_until(lambda: cell.mode() is RobotMode.FAULT)
        await cell.supervisor.reset()
        assert cell.plug() is PlugState.UNKNOWN
        # stopped without a warning, so that the board does not trust its encoder either
        with pytest.raises(RobotNotReadyError):
            cell.jog.hold("x", 1, 40.0)

    in_cell(scenario, STANDING)
