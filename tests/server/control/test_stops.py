from __future__ import annotations

import asyncio

import pytest

from drivers.robot import BoardState, FaultCode
from server.control.errors import (
    EmergencyStoppedError,
    RobotFaultError,
    RobotNotReadyError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.model import PlugState, RobotMode
from server.control.plug_guard import PlugRecord
from tests.support.robot_cell import AWAY, MemoryPlug, RobotCell, in_cell, parameters
from tests.support.virtual import wait_until
from twin.joints import JointPosition

FAR = JointPosition(300.0, 60.0, 50.0)


async def moving(cell: RobotCell, target: JointPosition = FAR) -> asyncio.Task[None]:
    """Begin a long motion with a lease of its own; returns in the middle of it."""

    async def go() -> None:
        async with cell.supervisor.control("job", "Plug-in job") as lease:
            await cell.supervisor.move_joints(lease, target)

    task = asyncio.create_task(go())
    await asyncio.sleep(0.8)
    assert cell.moving()
    return task


def test_stop_brings_a_moving_robot_to_rest_within_a_tenth_of_a_second() -> None:
    async def scenario(cell: RobotCell) -> float:
        task = await moving(cell)
        speed = max(abs(v) for v in cell.robot.measured.velocity)
        assert speed > 70.0
        pressed_s = asyncio.get_running_loop().time()
        stopping = asyncio.create_task(cell.supervisor.stop())
        await wait_until(lambda: not cell.moving())
        rest_s = asyncio.get_running_loop().time() - pressed_s
        await stopping
        with pytest.raises(RobotStoppedError):
            await task
        assert cell.mode() is RobotMode.STOPPED
        assert cell.holder() is None
        assert cell.robot.enabled, "category 2 keeps the drives on"
        here = cell.now
        await asyncio.sleep(5.0)
        assert cell.now == here
        return rest_s

    # 80 mm/s at 1500 mm/s^2 are 53 ms, and the way to the board 1.5 ms
    assert in_cell(scenario) == pytest.approx(0.056, abs=0.004)


def test_an_emergency_stop_also_releases_the_drives_and_outlives_the_link() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await moving(cell)
        await cell.supervisor.emergency_stop()
        with pytest.raises(EmergencyStoppedError):
            await task
        await wait_until(lambda: not cell.robot.enabled)
        assert cell.mode() is RobotMode.EMERGENCY_STOP
        assert cell.supervisor.fault is not None
        assert cell.supervisor.fault.code is FaultCode.EMERGENCY_STOP
        async with cell.supervisor.control("jog", "Test") as lease:
            for call in (cell.supervisor.enable, cell.supervisor.home):
                with pytest.raises(EmergencyStoppedError):
                    await call(lease)
            with pytest.raises(EmergencyStoppedError):
                await cell.supervisor.move_joints(lease, AWAY)
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.OFF

    in_cell(scenario)


def test_the_boards_own_emergency_stop_is_latched_here_too() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await moving(cell)
        await cell.garage.robot.emergency_stop()
        with pytest.raises(EmergencyStoppedError):
            await task
        await wait_until(lambda: not cell.moving())
        await cell.garage.robot.clear_fault()  # somebody else's command: the latch here stays
        await asyncio.sleep(0.5)
        assert cell.mode() is RobotMode.EMERGENCY_STOP
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.OFF

    in_cell(scenario)


def test_stop_while_homing_ends_it_with_the_reason_and_at_rest() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def home() -> None:
            async with cell.supervisor.control("homing", "Homing") as lease:
                await cell.supervisor.home(lease)

        for delay_s in (0.3, 1.0, 2.7, 4.1, 5.505):
            task = asyncio.create_task(home())
            await asyncio.sleep(delay_s)
            assert cell.mode() is RobotMode.HOMING
            await cell.supervisor.stop()
            with pytest.raises(RobotStoppedError):
                await task
            assert not cell.moving()
            assert cell.holder() is None
            assert cell.mode() is RobotMode.STOPPED
            await cell.supervisor.reset()
            assert cell.mode() is RobotMode.NOT_HOMED
        async with cell.supervisor.control("homing", "Homing") as lease:
            with pytest.raises(RobotNotReadyError):
                await cell.supervisor.move_joints(lease, AWAY)

    in_cell(scenario, parameters(start_homed=False, start_joints=AWAY))


def test_homing_that_nobody_waits_for_any_more_is_stopped() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def home() -> None:
            async with cell.supervisor.control("homing", "Homing") as lease:
                await cell.supervisor.home(lease)

        task = asyncio.create_task(home())
        await asyncio.sleep(1.0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert not cell.moving(), "the lease was given back while the robot was moving"
        assert cell.mode() is RobotMode.NOT_HOMED

    in_cell(scenario, parameters(start_joints=AWAY))


def test_stop_while_jogging() -> None:
    async def scenario(cell: RobotCell) -> None:
        cell.jog.hold("x", 1, 40.0)
        await asyncio.sleep(0.2)
        assert cell.moving()
        await cell.supervisor.stop()
        await wait_until(lambda: not cell.moving(), 0.1)
        await cell.jog.wait_stopped()
        assert cell.holder() is None
        with pytest.raises(RobotStoppedError):
            cell.jog.hold("x", 1, 40.0)
        assert cell.holder() is None

    in_cell(scenario)


def test_stop_between_planning_and_the_first_step_keeps_the_robot_still() -> None:
    async def scenario(cell: RobotCell) -> None:
        here = cell.now
        pressed = False

        async def slow_disk(_record: PlugRecord) -> None:
            nonlocal pressed
            if not pressed:
                pressed = True
                await asyncio.sleep(0.05)
                await cell.supervisor.stop()
                await asyncio.sleep(0.3)

        cell.store.saving = slow_disk
        assert cell.plug() is PlugState.PARKED
        async with cell.supervisor.control("job", "Test") as lease:
            with pytest.raises(RobotStoppedError):
                await cell.supervisor.move_joints(lease, FAR)
        assert cell.now == here
        assert all(sample.board is not BoardState.RUN for sample in cell.samples)

    in_cell(scenario, store=MemoryPlug(PlugRecord(PlugState.PARKED, None)))


def test_stop_between_the_order_to_home_and_its_beginning() -> None:
    async def scenario(cell: RobotCell) -> None:
        async def slow_disk(_record: PlugRecord) -> None:
            await cell.supervisor.stop()

        cell.store.saving = slow_disk
        async with cell.supervisor.control("homing", "Test") as lease:
            with pytest.raises(RobotStoppedError):
                await cell.supervisor.home(lease)
        assert all(sample.board is not BoardState.HOMING for sample in cell.samples)

    in_cell(scenario, store=MemoryPlug(PlugRecord(PlugState.PARKED, None)))


def test_a_stop_pressed_without_a_link_is_in_force_when_it_comes_back() -> None:
    async def scenario(cell: RobotCell) -> None:
        cell.garage.robot.unplug_link()
        await wait_until(lambda: cell.mode() is RobotMode.OFFLINE)
        await cell.supervisor.stop()
        with pytest.raises(RobotOfflineError):
            await cell.supervisor.reset()
        cell.garage.robot.replug_link()
        await wait_until(lambda: cell.mode() is not RobotMode.OFFLINE)
        assert cell.supervisor.fault is not None
        assert cell.supervisor.fault.code is FaultCode.HEARTBEAT_LOST
        await cell.garage.robot.clear_fault()
        await wait_until(lambda: cell.mode() is RobotMode.STOPPED)
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.OFF

    in_cell(scenario)


def test_a_stop_pressed_while_another_is_being_released_is_not_released_with_it() -> None:
    async def scenario(cell: RobotCell) -> None:
        await cell.supervisor.emergency_stop()
        await wait_until(lambda: cell.supervisor.fault is not None)
        releasing = asyncio.create_task(cell.supervisor.reset())
        await asyncio.sleep(0.001)
        await cell.supervisor.stop()
        with pytest.raises(RobotStoppedError, match="again"):
            await releasing
        assert cell.mode() in {RobotMode.EMERGENCY_STOP, RobotMode.STOPPED}
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.OFF

    in_cell(scenario)


def test_a_fault_whose_cause_is_there_still_is_not_released() -> None:
    async def scenario(cell: RobotCell) -> None:
        task = await moving(cell)
        cell.garage.robot.press_stop_button()
        with pytest.raises(EmergencyStoppedError, match="circuit is open"):
            await task
        await wait_until(lambda: not cell.moving())
        with pytest.raises(RobotFaultError, match="circuit is open"):
            await cell.supervisor.reset()
        assert cell.supervisor.fault is not None
        cell.garage.robot.release_stop_button()
        await cell.supervisor.reset()
        assert cell.mode() is RobotMode.OFF
        assert not cell.robot.homed, "its motors were without power"

    in_cell(scenario)


def test_only_a_stall_is_released_without_a_person() -> None:
    async def scenario(cell: RobotCell) -> None:
        supervisor = cell.supervisor
        async with supervisor.control("job", "Test") as lease:
            cell.garage.robot.jam()
            with pytest.raises(RobotFaultError) as raised:
                await supervisor.move_joints(lease, cell.now._replace(rho3_mm=80.0))
            assert raised.value.context["fault"] == FaultCode.STALL.value
            await supervisor.stop()
            await supervisor.release_stall(lease)
            assert supervisor.fault is None
            assert cell.mode() is RobotMode.STOPPED, "a person's stop stays"
            await supervisor.reset()
            cell.garage.robot.free_jam()
            await supervisor.emergency_stop()
            await wait_until(lambda: supervisor.fault is not None)
            await supervisor.release_stall(lease)
            assert cell.mode() is RobotMode.EMERGENCY_STOP

    in_cell(scenario)
