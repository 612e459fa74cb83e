"""A robot that was not built as drawn, moved by somebody who thinks it was."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from drivers.robot import MeasuredJoints
from drivers.simulator.parameters import BuildErrors
from server.control.built_robot import BuiltRobot
from server.control.errors import (
    CalibrationHeldError,
    CalibrationUnusableError,
    ControlLostError,
    MotionOutOfReachError,
)
from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugRecord
from tests.support.robot_cell import AWAY, GEOMETRY, HOME, LIMITS, MemoryPlug, RobotCell, in_cell
from tests.support.robot_cell import parameters as perfect
from twin.as_built import JointCorrection, PlanarAsBuilt
from twin.joints import JointPosition, JointVelocity
from twin.kinematics import alpha
from twin.motion import plan_joint_move, plan_segments
from twin.motion.segments import Segment

FAR = JointPosition(300.0, 80.0, 60.0)
PLACES = (FAR, AWAY, JointPosition(60.0, 240.0, 50.0), HOME)
BADLY_BUILT = perfect().model_copy(
    update={
        "build": BuildErrors.before_calibration().model_copy(
            update={
                "sag_scale": 0.0,
                "mount_offset_std_mm": 0.0,
                "mount_angle_std_rad": 0.0,
                "theta_std_rad": 0.0,
            }
        )
    }
)


def truth(cell: RobotCell) -> PlanarAsBuilt:
    return cell.garage.world.plant.mechanism


def missed_mm(cell: RobotCell, target: JointPosition) -> float:
    """How far the platform really stands from where the drawing has it."""
    wanted = alpha.forward_many(GEOMETRY, np.array(target[:2]))
    there = truth(cell).forward(*cell.now[:2])
    return float(np.linalg.norm(np.array(there) - wanted))


async def calibrate(cell: RobotCell, mechanism: PlanarAsBuilt | None) -> None:
    async with cell.supervisor.control("calibration", "Test") as lease:
        cell.supervisor.use_built(lease, BuiltRobot.of(GEOMETRY, mechanism))


async def move(cell: RobotCell, target: JointPosition) -> None:
    async with cell.supervisor.control("job", "Test") as lease:
        await cell.supervisor.move_joints(lease, target)


def pushed(cell: RobotCell) -> list[Segment]:
    """All segments that the board takes from now on."""
    board = cell.garage.robot._board
    taken: list[Segment] = []
    push = board.push

    def counted(segments: Sequence[Segment], now_s: float) -> None:
        push(segments, now_s)
        taken.extend(segments)

    board.push = counted  # type: ignore[method-assign]  # a probe
    return taken


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_platform_of_a_calibrated_robot_goes_where_the_drawing_says(seed: int) -> None:
    async def scenario(cell: RobotCell) -> None:
        before = []
        for place in PLACES:
            await move(cell, place)
            before.append(missed_mm(cell, place))
        await calibrate(cell, truth(cell))
        for place in PLACES:
            await move(cell, place)
            assert missed_mm(cell, place) < 0.01, "a step of the motors is 0.004 mm"
            assert cell.robot.commanded.position == pytest.approx(place, abs=1e-6)
            assert cell.robot.measured.position == pytest.approx(place, abs=0.03)
        assert max(before) > 1.0, "as it was built it misses"
        assert cell.supervisor.fault is None

    in_cell(scenario, BADLY_BUILT, seed=seed)


def test_what_is_seen_on_the_way_is_the_drawn_motion() -> None:
    async def scenario(cell: RobotCell) -> None:
        await calibrate(cell, truth(cell))
        seen: list[Segment] = []
        cell.supervisor.listen_to_segments(seen.extend)
        async with cell.supervisor.control("job", "Test") as lease:
            start = cell.robot.commanded.position
            plan = plan_joint_move(cell.supervisor.limits, start, FAR)
            await cell.supervisor.follow(lease, plan)
        assert seen == plan_segments(plan, 0.02)
        began = next(s for s in cell.samples if max(map(abs, s.commanded.velocity)) > 5)
        t_s = plan_time(plan_segments(plan, 0.02), began.commanded.position.rho1_mm)
        for sample in cell.samples:
            at_s = t_s + sample.sampled_at_s - began.sampled_at_s
            if not 0 < at_s < plan.duration_s:
                continue
            assert sample.commanded.position == pytest.approx(plan.position_at(at_s), abs=0.1)
            assert sample.commanded.velocity == pytest.approx(plan.velocity_at(at_s), abs=1.5)

    in_cell(scenario, BADLY_BUILT, seed=2)


def plan_time(segments: Sequence[Segment], rho1_mm: float) -> float:
    """When a motion that only goes on passes a place."""
    at_s = 0.0
    for segment in segments:
        if segment.end.rho1_mm >= rho1_mm:
            way = (rho1_mm - segment.start.rho1_mm) / (segment.end.rho1_mm - segment.start.rho1_mm)
            return at_s + way * segment.duration_s
        at_s += segment.duration_s
    return at_s


def test_without_calibration_the_board_gets_the_plan_itself() -> None:
    async def scenario(cell: RobotCell) -> None:
        taken = pushed(cell)
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(cell.supervisor.limits, cell.robot.commanded.position, FAR)
            await cell.supervisor.follow(lease, plan)
        assert taken == plan_segments(plan, 0.02)
        assert cell.supervisor.limits is LIMITS
        assert cell.supervisor.board_state is cell.supervisor.telemetry.latest

    in_cell(scenario)


@pytest.mark.parametrize("at_s", [0.1, 0.5, 1.0])
def test_a_calibrated_robot_bends_to_another_target_without_a_jolt(at_s: float) -> None:
    async def scenario(cell: RobotCell) -> None:
        await calibrate(cell, truth(cell))
        taken = pushed(cell)
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(cell.supervisor.limits, cell.robot.commanded.position, FAR)
            motion = cell.supervisor.start_motion(lease, plan, changeable=True)
            run = asyncio.create_task(cell.supervisor.run(motion))
            await asyncio.sleep(at_s)
            cell.supervisor.retarget(motion, AWAY)
            await run
        assert missed_mm(cell, AWAY) < 0.01
        for before, after in itertools.pairwise(taken):
            assert after.start == pytest.approx(before.end, abs=1e-9)
            assert after.velocity == pytest.approx(before.end_velocity, abs=1e-5)

    in_cell(scenario, BADLY_BUILT, seed=3)


def test_what_leaves_the_travel_of_the_board_is_refused_before_the_first_step() -> None:
    """The drawing allows it, the built robot would run into its end."""

    async def scenario(cell: RobotCell) -> None:
        drawn = PlanarAsBuilt.as_drawn(GEOMETRY)
        await calibrate(
            cell, drawn.model_copy(update={"left_foot_x_mm": drawn.left_foot_x_mm - 4.0})
        )
        here = cell.now
        with pytest.raises(MotionOutOfReachError, match=r"rho1 would have to go to 42\d\.\d mm"):
            await move(cell, JointPosition(419.0, 30.0, 60.0))
        assert cell.now == here

    in_cell(scenario)


def test_a_carriage_that_must_run_faster_is_planned_slower() -> None:
    drawn = PlanarAsBuilt.as_drawn(GEOMETRY)
    stretched = BuiltRobot.of(GEOMETRY, drawn.model_copy(update={"left_scale": 0.95}))
    assert stretched.limits(LIMITS).rho1.velocity_mm_s == pytest.approx(0.95 * 80, rel=1e-3)
    assert BuiltRobot.of(GEOMETRY, drawn).limits(LIMITS).rho1.velocity_mm_s == pytest.approx(80)


@pytest.mark.parametrize("seed", range(12))
def test_no_motion_of_a_badly_built_robot_is_too_fast_for_its_board(seed: int) -> None:
    rng = np.random.default_rng(seed)
    off = np.array([3.0] * 6 + [0.009] * 2 + [0.005] * 2) * rng.uniform(-1, 1, 10)
    mechanism = PlanarAsBuilt.from_vector(PlanarAsBuilt.as_drawn(GEOMETRY).vector + off)
    built = BuiltRobot.of(GEOMETRY, mechanism)
    assert built.speed_share > 0.8
    limits = built.limits(LIMITS)
    for _ in range(20):
        ways = np.array([650.0, 335.0]) + rng.uniform(-100, 100, (2, 2))
        start, end = alpha.inverse_many(GEOMETRY, ways).tolist()
        plan = plan_joint_move(
            limits, JointPosition(start[0], start[1], 50.0), JointPosition(end[0], end[1], 50.0)
        )
        for step in built.steps(plan, 0.02):
            assert max(map(abs, step.board.end_velocity)) < LIMITS.rho1.velocity_mm_s + 0.1


def test_joints_that_are_no_pose_are_shown_as_they_are() -> None:
    async def scenario(cell: RobotCell) -> None:
        state = cell.robot
        nowhere = JointPosition(-200.0, -200.0, 50.0)
        lost = MeasuredJoints(nowhere, state.measured.velocity)
        built = BuiltRobot.of(GEOMETRY, truth(cell))
        broken = replace(state, measured=lost)
        assert built.seen(broken) is broken

    in_cell(scenario, BADLY_BUILT)


def test_nobody_changes_the_calibration_with_the_plug_in_a_socket_or_without_control() -> None:
    held = PlugRecord(PlugState.INSERTED, Corridor(150.0, 150.0, 50.0, 75.0, 115.0))

    async def scenario(cell: RobotCell) -> None:
        with pytest.raises(CalibrationHeldError):
            await calibrate(cell, truth(cell))
        async with cell.supervisor.control("calibration", "Test") as lease:
            pass
        with pytest.raises(ControlLostError):
            cell.supervisor.use_built(lease, BuiltRobot())
        assert cell.supervisor.built == BuiltRobot()

    in_cell(scenario, BADLY_BUILT, store=MemoryPlug(held))


def test_a_gauge_that_is_off_counts_in_true_newtons_both_ways() -> None:
    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("calibration", "Test") as lease:
            cell.supervisor.use_built(lease, BuiltRobot.of(GEOMETRY, None, force_scale=1.25))
            await cell.supervisor.set_force_limit(lease, 60.0)
        board = cell.supervisor.board_state
        assert board is not None
        pushed = replace(board, force_n=50.0)
        assert cell.supervisor.built.seen(pushed).force_n == pytest.approx(40.0)
        assert cell.garage.world._force_limit_n == pytest.approx(75.0)

    in_cell(scenario)


@pytest.mark.parametrize("scale", [0.5, 1.6, float("nan")])
def test_a_gauge_that_is_far_off_is_refused(scale: float) -> None:
    with pytest.raises(CalibrationUnusableError):
        BuiltRobot.of(GEOMETRY, None, scale)


def test_the_map_and_its_velocities_go_both_ways() -> None:
    built = PlanarAsBuilt.from_vector(
        PlanarAsBuilt.as_drawn(GEOMETRY).vector
        + np.array([2.5, -1.5, 1.0, 2.0, -2.5, -1.0, 0.008, -0.006, 0.004, -0.005])
    )
    correction = JointCorrection(GEOMETRY, built)
    for place in PLACES:
        drawn = correction.from_board(place)
        np.testing.assert_allclose(
            drawn, correction.from_board_many(np.array([place]))[0], atol=1e-9
        )
        velocity = JointVelocity(30.0, -70.0, 5.0)
        back = correction.velocity_from_board(place, velocity)
        rates = correction.rates_many(np.array([drawn]))[0]
        np.testing.assert_allclose(rates @ np.array(back), velocity, atol=1e-5)


@pytest.mark.parametrize(
    "numbers",
    [
        {"left_leg_mm": 50.0},
        {"right_foot_y_mm": 5000.0},
        {"left_scale": 0.8, "right_rail_rad": 0.2, "left_rail_rad": -0.2},
        {"left_foot_x_mm": 9000.0},
    ],
)
def test_numbers_of_no_robot_like_this_are_refused(numbers: dict[str, float]) -> None:
    mechanism = PlanarAsBuilt.as_drawn(GEOMETRY).model_copy(update=numbers)
    with pytest.raises(CalibrationUnusableError):
        BuiltRobot.of(GEOMETRY, mechanism)
