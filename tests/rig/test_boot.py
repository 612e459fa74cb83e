"""From power-up and reset to a board that has introduced itself."""

from __future__ import annotations

import asyncio

import pytest

from drivers.robot import BoardState, NotConnectedError
from tests.rig.build import Programs
from tests.rig.control import ControlError
from tests.rig.host import at_rest, sample_where
from tests.rig.rig import running_rig

CONNECTED_WITHIN_S = 1.0


async def test_the_board_introduces_itself_soon_after_its_port_was_opened(
    programs: Programs,
) -> None:
    async with running_rig(programs) as rig:
        robot = rig.robot()
        began_s = asyncio.get_running_loop().time()
        identity = await robot.connect()
        took_s = asyncio.get_running_loop().time() - began_s
        state = await at_rest(robot)
        truth = await rig.control.state()
        statistics = await rig.control.statistics()
        await robot.close()
    assert identity.name == "Me Auriga"
    assert took_s < CONNECTED_WITHIN_S
    assert truth.resets == 1, "opening the port resets the board"
    assert state.board is BoardState.IDLE
    assert not state.homed
    assert not truth.relay, "no power before it was asked for"
    assert statistics.wrong_baud == 0
    assert statistics.rails[0].steps == statistics.rails[1].steps == 0


async def test_a_reset_in_the_middle_ends_the_link_and_drops_the_power(
    programs: Programs,
) -> None:
    async with running_rig(programs) as rig:
        robot = rig.robot()
        await robot.connect()
        await robot.enable()
        await sample_where(robot, lambda state: state.enabled)
        assert (await rig.control.state()).relay
        await rig.control.reset()
        with pytest.raises(AssertionError, match="the telemetry ended"):
            await sample_where(robot, lambda state: not state.enabled)
        assert not (await rig.control.state()).relay
        with pytest.raises(NotConnectedError):
            await robot.enable()
        await robot.connect()
        assert not (await at_rest(robot)).enabled
        await robot.close()


async def test_a_hung_firmware_is_restarted_by_its_watchdog(programs: Programs) -> None:
    async with running_rig(programs) as rig:
        robot = rig.robot()
        await robot.connect()
        await robot.enable()
        hung = await rig.control.state()
        await rig.control.hang()
        with pytest.raises(AssertionError, match="the telemetry ended"):
            await sample_where(robot, lambda _: False)
        restarted = await rig.control.state()
        assert restarted.resets == hung.resets + 1
        assert not restarted.relay
        await robot.close()


async def test_the_simulator_refuses_what_it_does_not_understand(programs: Programs) -> None:
    async with running_rig(programs) as rig:
        for line in ("nonsense", "switch 3 cut", "load 1 0 5", "load 1 1 x", "faults 1 2"):
            with pytest.raises(ControlError):
                await rig.control.say(line)
