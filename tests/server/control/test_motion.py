from __future__ import annotations

import asyncio
import itertools
from collections.abc import Sequence

import numpy as np
import pytest

from drivers.robot import BoardState, StopCategory
from server.control.errors import (
    ForceLimitError,
    MotionOutOfReachError,
    MotionRefusedError,
    RobotFaultError,
    RobotStoppedError,
)
from server.control.model import RobotMode
from tests.support.robot_cell import AWAY, LIMITS, RobotCell, in_cell, parameters
from tests.support.virtual import oversleep, wait_until
from twin.joints import JointPosition
from twin.motion import plan_joint_move
from twin.motion.segments import Segment

FAR = JointPosition(300.0, 60.0, 60.0)


async def move(cell: RobotCell, target: JointPosition = FAR) -> None:
    async with cell.supervisor.control("job", "Test") as lease:
        await cell.supervisor.move_joints(lease, target)


def watch_queue(cell: RobotCell) -> tuple[list[int], list[Segment]]:
    """Length of the board's queue after every push, and all segments it took."""
    board = cell.garage.robot._board
    lengths: list[int] = []
    taken: list[Segment] = []
    push = board.push

    def counted(segments: Sequence[Segment], now_s: float) -> None:
        push(segments, now_s)
        lengths.append(board._numbers.queue_capacity - board.queue_free(now_s))
        taken.extend(segments)

    board.push = counted  # type: ignore[method-assign]  # a probe
    return lengths, taken


@pytest.mark.parametrize(("changeable", "look_ahead"), [(True, 8), (False, 16)])
def test_the_queue_is_never_fuller_than_the_look_ahead_and_the_plan_is_sent_once(
    changeable: bool, look_ahead: int
) -> None:
    async def scenario(cell: RobotCell) -> None:
        lengths, taken = watch_queue(cell)
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(LIMITS, cell.robot.commanded.position, FAR)
            motion = cell.supervisor.start_motion(lease, plan, changeable=changeable)
            await cell.supervisor.run(motion)
        assert max(lengths) == look_ahead
        assert len(lengths) > 20
        for before, after in itertools.pairwise(taken):
            assert after.start == pytest.approx(before.end, abs=1e-9)
            assert after.velocity == pytest.approx(before.end_velocity, abs=1e-9)
        assert taken[-1].end == pytest.approx(FAR, abs=1e-9)
        assert cell.now == pytest.approx(FAR, abs=0.03)

    in_cell(scenario)


@pytest.mark.parametrize("capacity", [2, 5, 8, 40])
def test_a_board_with_another_queue_is_fed_as_it_can_take(capacity: int) -> None:
    """The move has eleven segments of this length."""

    async def scenario(cell: RobotCell) -> int:
        lengths, _ = watch_queue(cell)
        await move(cell, AWAY)
        return max(lengths)

    fullest = in_cell(scenario, parameters(queue_capacity=capacity, segment_s=0.1))
    assert fullest == min(capacity, 11)


def test_a_busy_computer_does_not_starve_the_board() -> None:
    """Gaps of 200 ms, again and again, at every phase of the feeding."""

    async def scenario(cell: RobotCell) -> None:
        async def be_busy() -> None:
            rng = np.random.default_rng(1)
            while True:
                await asyncio.sleep(float(rng.uniform(0.05, 0.2)))
                await oversleep(0.2)

        busy = asyncio.create_task(be_busy())
        lengths, _ = watch_queue(cell)
        for _ in range(3):
            await move(cell, FAR)
            await move(cell, AWAY)
        busy.cancel()
        assert cell.supervisor.fault is None
        assert max(lengths) <= 16

    in_cell(scenario)


def test_a_gap_longer_than_the_look_ahead_ends_in_a_fault_and_at_rest() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = asyncio.create_task(move(cell))
        await asyncio.sleep(0.8)
        await oversleep(0.5)
        with pytest.raises(RobotFaultError) as raised:
            await task
        assert raised.value.context["fault"] == "queue_underrun"
        assert not cell.moving()
        assert cell.holder() is None

    in_cell(scenario)


def test_slow_telemetry_and_commands_do_not_overfill_or_starve() -> None:
    async def scenario(cell: RobotCell) -> None:
        lengths, _ = watch_queue(cell)
        await move(cell)
        assert max(lengths) <= 16
        assert cell.supervisor.fault is None

    in_cell(scenario, parameters(telemetry_delay_s=0.03, command_delay_s=0.02))


@pytest.mark.parametrize("cancel_at_s", [0.0, 0.001, 0.02, 0.8, 1.6])
def test_cancelling_halts_before_the_lease_is_given_back(cancel_at_s: float) -> None:
    async def scenario(cell: RobotCell) -> None:
        task = asyncio.create_task(move(cell))
        await asyncio.sleep(cancel_at_s)
        while not task.done():
            task.cancel()  # again and again: the halt must be finished all the same
            await asyncio.sleep(0.007)
            assert (cell.holder() is None) == task.done()
        assert task.cancelled()
        assert not cell.moving()
        assert cell.robot.enabled
        assert cell.mode() is RobotMode.READY, "nothing is latched"
        await move(cell, AWAY)

    in_cell(scenario)


def test_the_watch_sees_every_sample_also_while_a_push_takes_long() -> None:
    async def scenario(cell: RobotCell) -> None:
        seen: list[float] = []
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(LIMITS, cell.robot.commanded.position, FAR)
            await cell.supervisor.follow(lease, plan, lambda s: seen.append(s.sampled_at_s))
        known = [state.sampled_at_s for state in cell.samples]
        assert len(seen) > 100
        assert seen == known[known.index(seen[0]) : known.index(seen[-1]) + 1]

    in_cell(scenario, parameters(telemetry_delay_s=0.02, command_delay_s=0.03))


@pytest.mark.parametrize("changeable", [True, False])
def test_a_line_that_is_slow_both_ways_does_not_drain_the_queue(changeable: bool) -> None:
    async def scenario(cell: RobotCell) -> None:
        lengths, _ = watch_queue(cell)
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(LIMITS, cell.robot.commanded.position, FAR)
            motion = cell.supervisor.start_motion(lease, plan, changeable=changeable)
            await cell.supervisor.run(motion)
        cruising = lengths[2:-4]
        assert min(cruising) >= (6 if changeable else 12)

    in_cell(scenario, parameters(telemetry_delay_s=0.021, command_delay_s=0.023))


def test_a_watch_that_objects_halts_the_motion() -> None:
    async def scenario(cell: RobotCell) -> None:
        seen: list[float] = []

        def watch(_state: object) -> None:
            seen.append(asyncio.get_running_loop().time())
            if len(seen) == 60:
                raise ForceLimitError("Too much.")

        async with cell.supervisor.control("job", "Test") as lease:
            with pytest.raises(ForceLimitError):
                await cell.supervisor.move_joints(lease, FAR, watch)
            assert not cell.moving()
        gaps = np.diff(seen[5:])
        assert max(gaps) < 0.03, "no long blindness while segments are sent"

    in_cell(scenario)


@pytest.mark.parametrize("at_s", [0.001, 0.1, 0.5, 1.0, 1.5])
@pytest.mark.parametrize("target", [FAR._replace(rho1_mm=290.0), AWAY], ids=["near", "back"])
def test_a_new_target_in_flight_bends_the_motion_without_a_jolt(
    at_s: float, target: JointPosition
) -> None:
    async def scenario(cell: RobotCell) -> None:
        _, taken = watch_queue(cell)
        async with cell.supervisor.control("job", "Test") as lease:
            start = cell.robot.commanded.position
            plan = plan_joint_move(LIMITS, start, FAR)
            motion = cell.supervisor.start_motion(lease, plan, changeable=True)
            run = asyncio.create_task(cell.supervisor.run(motion))
            await asyncio.sleep(at_s)
            cell.supervisor.retarget(motion, target)
            state = await run
        assert state.board is BoardState.READY
        assert state.commanded.position == pytest.approx(target, abs=0.02)
        accelerations = []
        for before, after in itertools.pairwise(taken):
            assert after.start == pytest.approx(before.end, abs=1e-9)
            assert after.velocity == pytest.approx(before.end_velocity, abs=1e-6)
            accelerations.append(np.subtract(after.acceleration, before.acceleration))
        # 4000 mm/s^3 over a segment of 20 ms, and the rounding of the segments
        assert np.abs(accelerations).max() < 1.5 * 4000 * 0.02

    in_cell(scenario)


def test_a_new_target_out_of_reach_leaves_the_old_one() -> None:
    async def scenario(cell: RobotCell) -> None:
        async with cell.supervisor.control("job", "Test") as lease:
            start = cell.robot.commanded.position
            plan = plan_joint_move(LIMITS, start, AWAY)
            motion = cell.supervisor.start_motion(lease, plan, changeable=True)
            run = asyncio.create_task(cell.supervisor.run(motion))
            await asyncio.sleep(0.3)
            with pytest.raises(MotionOutOfReachError):
                cell.supervisor.retarget(motion, AWAY._replace(rho3_mm=151.0))
            state = await run
        assert state.commanded.position == pytest.approx(AWAY, abs=0.02)

    in_cell(scenario)


def test_a_motion_that_the_board_ends_by_itself_is_noticed() -> None:
    """Such as a stop button on the board that latches nothing."""

    async def scenario(cell: RobotCell) -> None:
        task = asyncio.create_task(move(cell))
        await wait_until(lambda: cell.robot.board is BoardState.RUN)
        await asyncio.sleep(0.5)
        await cell.garage.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        with pytest.raises((MotionRefusedError, RobotStoppedError)):
            await asyncio.wait_for(task, 5.0)
        # the same when all segments are on the board already
        task = asyncio.create_task(move(cell, cell.now._replace(rho3_mm=60.5)))
        await asyncio.sleep(0.04)
        await cell.garage.robot.stop(StopCategory.DECELERATE_AND_HOLD)
        with pytest.raises((MotionRefusedError, RobotStoppedError)):
            await asyncio.wait_for(task, 5.0)

    in_cell(scenario)


def test_a_motion_to_where_the_robot_stands_is_over_at_once() -> None:
    async def scenario(cell: RobotCell) -> None:
        await move(cell, AWAY)
        await move(cell, AWAY)
        assert cell.mode() is RobotMode.READY

    in_cell(scenario)


def test_a_plan_from_elsewhere_is_refused_by_the_board_and_leaves_the_robot_still() -> None:
    async def scenario(cell: RobotCell) -> None:
        here = cell.now
        async with cell.supervisor.control("job", "Test") as lease:
            plan = plan_joint_move(LIMITS, AWAY, FAR)
            with pytest.raises(MotionRefusedError):
                await cell.supervisor.follow(lease, plan)
        assert cell.now == here

    in_cell(scenario)
