"""The driver's commands, against a board that speaks the real protocol."""

from __future__ import annotations

from itertools import pairwise

import pytest

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.protocol import messages
from drivers.arduino.settings import BoardSettings
from drivers.robot import (
    BoardRefusedError,
    BoardState,
    FaultCode,
    QueueFullError,
    StopCategory,
)
from tests.drivers.arduino.driving import (
    HOME,
    LIMITS,
    STILL,
    move,
    until,
)
from tests.support.board_cable import BoardCable
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion import Segment, plan_joint_move, plan_segments


async def test_a_board_introduces_itself(robot: ArduinoRobot, cable: BoardCable) -> None:
    identity = await robot.connect()  # again: nothing happens
    assert identity.name == "Me Auriga"
    assert identity.firmware == "1.2.3"
    assert identity.queue_capacity == 16
    assert identity.segment_s == pytest.approx(0.02)
    assert cable.board.state is messages.State.IDLE, "it was configured"


async def test_homing_gives_valid_positions(robot: ArduinoRobot) -> None:
    assert not (await until(robot, lambda _: True)).homed
    await robot.enable()
    await robot.home()
    state = await until(robot, lambda _: True)
    assert state.homed
    assert state.enabled
    assert state.board is BoardState.READY
    assert state.measured.position == pytest.approx((150.0, 150.0, 50.0), abs=0.02)
    assert state.force_n == pytest.approx(12.3)


async def test_a_motion_ends_exactly_where_it_should(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    target = JointPosition(161.2345, 141.5, 52.25)
    samples = await move(homed, target)
    assert samples[-1].commanded.position == pytest.approx(target, abs=1e-6)
    assert samples[-1].fault is None
    scale = BoardSettings().rho1.units_per_mm
    assert cable.board.queue.position[0] / 2**31 / scale == pytest.approx(161.2345, abs=1e-6)
    moving = [s for s in samples if s.board is BoardState.RUN]
    assert len(moving) > 20
    fastest = max(s.commanded.velocity.rho1_mm_s for s in moving)
    assert 20 < fastest <= 80
    times = [s.sampled_at_s for s in samples]
    assert all(b > a for a, b in pairwise(times))
    assert all(0 <= s.received_at_s - s.sampled_at_s < 0.1 for s in samples)


async def test_several_motions_one_after_another(homed: ArduinoRobot) -> None:
    for target in (JointPosition(152, 149, 50), JointPosition(150, 150, 51.234)):
        samples = await move(homed, target)
        assert samples[-1].commanded.position == pytest.approx(target, abs=1e-6)


async def test_the_board_knows_better_and_says_why(robot: ArduinoRobot, cable: BoardCable) -> None:
    with pytest.raises(BoardRefusedError, match="the drives are off"):
        await robot.home()
    # positions that are allowed, but not known to be true
    cable.change(lambda board: board.queue.place((33988, 33988, 4650)))
    await robot.enable()
    await until(robot, lambda state: state.enabled)
    with pytest.raises(BoardRefusedError, match="before homing") as caught:
        await robot.push([STILL])
    assert caught.value.reason == "not_homed"


@pytest.mark.parametrize(
    ("segment", "why", "reason"),
    [
        (Segment(0.02, JointPosition(151, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, 0)), "rho1 jumps", "discontinuous"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 9, 0),
                 JointAcceleration(0, 0, 0)), "velocity of rho2 jumps", "rate_jump"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, -200)), "rho3 would go to", "beyond_travel"),
        (Segment(0.02, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(5000, 0, 0)), "would move at", "too_fast"),
        (Segment(0.5, JointPosition(150, 150, 50), JointVelocity(0, 0, 0),
                 JointAcceleration(0, 0, 0)), "it lasts", "bad_ticks"),
    ],
)  # fmt: skip
async def test_segments_that_the_board_cannot_follow_do_not_reach_it(
    homed: ArduinoRobot, cable: BoardCable, segment: Segment, why: str, reason: str
) -> None:
    with pytest.raises(BoardRefusedError, match=why) as caught:
        await homed.push([segment])
    assert caught.value.reason == reason
    assert not [m for m in cable.board.heard if isinstance(m, messages.Segment)]
    assert len(await move(homed, JointPosition(150.5, 150, 50))) > 2, "it still works"


async def test_a_full_queue_takes_nothing(homed: ArduinoRobot, cable: BoardCable) -> None:
    with pytest.raises(QueueFullError):
        await homed.push([STILL] * 17)
    assert not [m for m in cable.board.heard if isinstance(m, messages.Segment)]
    await homed.push([STILL] * 16)


async def test_after_a_stop_the_robot_goes_on_from_where_it_stands(homed: ArduinoRobot) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(180, 170, 55))
    await homed.push(plan_segments(plan, 0.02)[:12])
    await until(homed, lambda s: s.commanded.velocity.rho1_mm_s > 10)
    await homed.stop(StopCategory.DECELERATE_AND_HOLD)
    state = await until(homed, lambda s: s.board is BoardState.READY)
    assert state.enabled
    assert 150.1 < state.commanded.position.rho1_mm < 180
    samples = await move(homed, JointPosition(150, 150, 50))
    assert samples[-1].commanded.position == pytest.approx((150, 150, 50), abs=1e-6)


async def test_stops_release_or_hold(homed: ArduinoRobot) -> None:
    await homed.stop(StopCategory.DECELERATE_AND_HOLD)
    assert (await until(homed, lambda _: True)).enabled
    await homed.stop(StopCategory.DECELERATE_AND_RELEASE)
    state = await until(homed, lambda s: not s.enabled)
    assert state.board is BoardState.IDLE


async def test_an_emergency_stop_stays_until_it_is_cleared(homed: ArduinoRobot) -> None:
    await homed.emergency_stop()
    state = await until(homed, lambda s: s.fault is not None)
    assert state.board is BoardState.FAULT
    assert state.fault is not None
    assert state.fault.code is FaultCode.EMERGENCY_STOP
    with pytest.raises(BoardRefusedError, match="a fault is latched"):
        await homed.enable()
    await homed.clear_fault()
    assert (await until(homed, lambda s: s.fault is None)).board is BoardState.IDLE


async def test_the_stop_button_is_to_be_released_first(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    cable.change(lambda board: board.press_stop_button())
    state = await until(homed, lambda s: s.fault is not None and not s.homed)
    assert state.fault is not None
    assert state.fault.detail == "The emergency-stop circuit is open."
    with pytest.raises(BoardRefusedError, match="circuit is open") as caught:
        await homed.clear_fault()
    assert caught.value.reason == "cause_present"
    cable.change(lambda board: board.press_stop_button(pressed=False))
    await homed.clear_fault()


async def test_a_queue_that_runs_empty_is_a_fault(homed: ArduinoRobot) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(180, 170, 55))
    await homed.push(plan_segments(plan, 0.02)[:6])
    state = await until(homed, lambda s: s.fault is not None)
    assert state.fault is not None
    assert state.fault.code is FaultCode.QUEUE_UNDERRUN


async def test_a_single_lost_step_is_a_segment_mismatch(
    homed: ArduinoRobot, cable: BoardCable
) -> None:
    plan = plan_joint_move(LIMITS, HOME, JointPosition(158, 156, 51))
    await homed.push(plan_segments(plan, 0.02)[:14])
    cable.change(lambda board: board.queue.slip((0, -1, 0)))
    state = await until(homed, lambda s: s.fault is not None)
    assert state.fault is not None
    assert state.fault.code is FaultCode.SEGMENT_MISMATCH
    assert not state.homed
