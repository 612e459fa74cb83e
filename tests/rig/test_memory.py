"""What the board remembers over resets and power cuts, and what it refuses to believe."""

from __future__ import annotations

import asyncio

from drivers.arduino.configuration import configuration_crc, configuration_messages
from drivers.arduino.protocol.messages import Fault, Hello, ResetCause, State
from drivers.robot import BoardState
from tests.rig.build import Programs
from tests.rig.host import FAR, at_rest, on_the_way
from tests.rig.rig import Rig, running_rig
from twin.motion import MotionLimits

WATCHDOG_S = 0.3
"""From the hang to standstill: the watchdog bites after 250 ms, by its own imprecise clock."""

SAVED_S = 2.0
"""Writing the configuration takes 3.4 ms a byte."""

HELLO_S = 0.6
"""A board without a session introduces itself this often, or a little more."""

ADDRESSES = range(0, 1024, 37)
"""Of the EEPROM; the kept configuration lies among them."""


def hellos(rig: Rig) -> list[Hello]:
    """How the board has introduced itself so far."""
    return [h.frame.message for h in rig.heard if isinstance(h.frame.message, Hello)]


async def hello_after_power_cut(rig: Rig) -> Hello:
    """Take the power for a moment and listen."""
    await rig.control.reset(power=True)
    await asyncio.sleep(HELLO_S)
    return hellos(rig)[-1]


async def test_a_hang_in_motion_ends_at_the_watchdog_and_is_remembered(
    programs: Programs,
) -> None:
    async with running_rig(programs) as rig:
        robot = rig.robot()
        await robot.connect()
        await robot.enable()
        await robot.home()
        await rig.control.record_steps()
        async with on_the_way(robot, FAR):
            hung = await rig.control.hang()
            async for _ in robot.telemetry():
                pass  # until the link is lost
        restarted = hellos(rig)[-1]
        steps, _ = await rig.control.recorded_steps()
        assert restarted.reset_cause == ResetCause.WATCHDOG
        assert restarted.previous_fault == Fault.WATCHDOG
        assert not (await rig.control.state()).relay
        print(f"\nhang to standstill {(steps[-1].at_s - hung.simulated_s) * 1e3:.0f} ms")
        assert steps[-1].at_s - hung.simulated_s < WATCHDOG_S

        await robot.connect()
        state = await at_rest(robot)
        assert hellos(rig)[-1].previous_fault == Fault.WATCHDOG
        assert state.board in {BoardState.IDLE, BoardState.FAULT}
        assert not state.homed
        assert not state.enabled
        await robot.close()


async def test_the_configuration_outlives_a_power_cut(programs: Programs) -> None:
    async with running_rig(programs) as rig:
        crc = configuration_crc(
            configuration_messages(rig.machine.settings, rig.machine.geometry, MotionLimits())
        )
        robot = rig.robot()
        await robot.connect()
        assert hellos(rig)[-1].state == State.BOOT, "it was never configured"
        await asyncio.sleep(SAVED_S)
        await robot.close()

        await rig.cable.open_line("rig", lambda *_: None, lambda _: None)
        before = await hello_after_power_cut(rig)
        after = await hello_after_power_cut(rig)
        assert after.reset_cause == ResetCause.POWER_ON
        assert after.state == State.IDLE
        assert after.config_crc == before.config_crc == crc
        assert after.boot_id == before.boot_id + 1


async def test_a_spoilt_memory_is_refused_and_mended_by_the_next_connection(
    programs: Programs,
) -> None:
    async with running_rig(programs) as rig:
        robot = rig.robot()
        await robot.connect()
        await asyncio.sleep(SAVED_S)
        await robot.close()
        end = await rig.cable.open_line("rig", lambda *_: None, lambda _: None)
        whole = await hello_after_power_cut(rig)
        assert whole.state == State.IDLE

        vital = []
        for address in ADDRESSES:
            await rig.control.flip_eeprom(address, 0x10)
            hello = await hello_after_power_cut(rig)
            if hello.state == State.BOOT:
                assert hello.config_crc == 0
                vital.append(address)
            else:
                assert (hello.state, hello.config_crc) == (State.IDLE, whole.config_crc)
            await rig.control.flip_eeprom(address, 0x10)
        assert len(vital) > 3, "bytes of the configuration were among them"
        assert (await hello_after_power_cut(rig)).state == State.IDLE
        await end.close()

        await rig.control.flip_eeprom(vital[2])
        await robot.connect()
        assert (await at_rest(robot)).board is BoardState.IDLE
        await asyncio.sleep(SAVED_S)
        await robot.close()
        await rig.cable.open_line("rig", lambda *_: None, lambda _: None)
        assert (await hello_after_power_cut(rig)).config_crc == whole.config_crc
