"""A stopped robot keeps its power, so somebody must see that it stands still."""

from __future__ import annotations

from dataclasses import replace

from drivers.robot import BoardFault, BoardState, FaultCode, RobotState
from server.config.supervision import SupervisionSettings
from server.control.standstill import StandstillMonitor
from tests.support.robot_cell import RobotCell, in_cell
from twin.joints import JointVelocity

SETTINGS = SupervisionSettings()


async def _state(cell: RobotCell) -> RobotState:
    return cell.robot


STATE = in_cell(_state)


def sample(
    at_s: float,
    *,
    rho3_mm: float = 60.0,
    speed_mm_s: float = 0.0,
    board: BoardState = BoardState.READY,
) -> RobotState:
    measured = STATE.measured
    return replace(
        STATE,
        sampled_at_s=at_s,
        board=board,
        measured=replace(
            measured,
            position=measured.position._replace(rho3_mm=rho3_mm),
            velocity=JointVelocity(0.0, 0.0, speed_mm_s),
        ),
    )


def test_without_a_stop_it_sees_nothing_wrong() -> None:
    monitor = StandstillMonitor(SETTINGS)
    assert monitor.check(sample(0.0, speed_mm_s=50.0)) is None
    monitor.arm(1.0)
    monitor.disarm()
    assert monitor.check(sample(9.0, speed_mm_s=50.0)) is None


def test_a_robot_that_does_not_come_to_rest_is_named() -> None:
    monitor = StandstillMonitor(SETTINGS)
    monitor.arm(10.0)
    monitor.arm(10.9)  # pressing again gives no new time
    assert monitor.check(sample(9.9, speed_mm_s=50.0)) is None, "from before the stop"
    assert monitor.check(sample(10.5, speed_mm_s=50.0)) is None
    trouble = monitor.check(sample(11.01, speed_mm_s=50.0))
    assert trouble is not None
    assert "still moves" in trouble


def test_a_robot_at_rest_that_creeps_is_named() -> None:
    monitor = StandstillMonitor(SETTINGS)
    monitor.arm(10.0)
    assert monitor.check(sample(10.1, board=BoardState.STOPPING)) is None
    assert not monitor.at_rest
    assert monitor.check(sample(10.2)) is None
    assert monitor.at_rest
    assert monitor.check(sample(500.0, rho3_mm=60.4)) is None
    trouble = monitor.check(sample(501.0, rho3_mm=59.4))
    assert trouble is not None
    assert "0.6 mm" in trouble


def test_a_robot_without_power_may_be_pushed() -> None:
    monitor = StandstillMonitor(SETTINGS)
    monitor.arm(10.0)
    fault = BoardFault(FaultCode.EMERGENCY_STOP, "pressed")
    faulty = replace(sample(10.1, board=BoardState.FAULT), fault=fault)
    assert monitor.check(faulty) is None
    assert monitor.check(replace(sample(12.0, rho3_mm=80.0), enabled=False)) is None
