"""The emergency-stop button and a silent host, treated as the real board treats them."""

from __future__ import annotations

import asyncio

import pytest

from drivers.robot import BoardRefusedError, FaultCode, RobotState
from tests.drivers.simulator.stand import Stand, on_stand
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.segments import Segment

HOME = JointPosition(150.0, 150.0, 50.0)
AWAY = JointPosition(250.0, 170.0, 60.0)
STILL = Segment(0.02, HOME, JointVelocity(0.0, 0.0, 0.0), JointAcceleration(0.0, 0.0, 0.0))


def test_the_stop_button_takes_the_position_away_and_hinders_clearing() -> None:
    async def scenario(stand: Stand) -> None:
        await stand.robot.push((await stand.segments_to(AWAY))[:16])
        await asyncio.sleep(0.15)
        stand.robot.press_stop_button()
        await stand.rest()
        await asyncio.sleep(0.3)
        state = await stand.state()
        assert state.fault is not None
        assert state.fault.code is FaultCode.EMERGENCY_STOP
        assert not state.enabled
        assert not state.homed, "its motors were without power"
        with pytest.raises(BoardRefusedError, match="emergency-stop circuit") as caught:
            await stand.robot.clear_fault()
        assert caught.value.reason == "cause_present"
        stand.robot.release_stop_button()
        await stand.robot.clear_fault()
        await stand.robot.enable()
        with pytest.raises(BoardRefusedError, match="homing") as caught:
            await stand.robot.push([STILL])
        assert caught.value.reason == "not_homed"

    on_stand(scenario)


@pytest.mark.parametrize("enabled", [True, False])
def test_silence_of_the_host_matters_while_the_drives_are_on(enabled: bool) -> None:
    async def scenario(stand: Stand) -> RobotState:
        if not enabled:
            await stand.robot.disable()
        stand.robot.unplug_link()
        await asyncio.sleep(1.0)
        stand.robot.replug_link()
        await asyncio.sleep(1.0)
        await stand.robot.connect()
        return await stand.state()

    state = on_stand(scenario)
    assert state.enabled is False
    assert (state.fault is not None) is enabled
