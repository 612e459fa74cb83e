"""The real serial driver: threads, pyserial, and a device that comes and goes.

Nothing moves here, and nothing depends on how long anything takes: the machine may be busy.
"""

from __future__ import annotations

import asyncio
import os
import pty
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import serial

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.errors import BoardNotFoundError, BoardSilentError
from drivers.robot import BoardState, NotConnectedError
from tests.rig.build import Programs
from tests.rig.device.running import robot_at, running_device
from tests.rig.machine import standing_machine
from tests.support.eventually import eventually
from twin.motion import MotionLimits

ANOTHER_SPEED = 115_200


async def reconnect(robot: ArduinoRobot) -> None:
    """Connect as the server does: again, if a busy machine has broken the link meanwhile."""

    async def connected() -> bool:
        try:
            await robot.connect()
        except NotConnectedError:
            return False
        return True

    await eventually(connected, within_s=60.0)


async def test_the_board_introduces_itself_after_its_port_was_opened(programs: Programs) -> None:
    async with running_device(programs) as rig:
        robot = robot_at(rig)
        await reconnect(robot)
        identity = await robot.connect()
        state = await anext(aiter(robot.telemetry()))
        truth = await rig.control.state()
        statistics = await rig.control.statistics()
        await robot.close()
    assert identity.name == "Me Auriga"
    assert truth.resets >= 1, "opening the port resets the board"
    assert state.board is BoardState.IDLE
    assert not truth.relay
    assert statistics.wrong_baud == 0


async def test_a_pulled_plug_ends_the_link_and_a_plug_put_back_begins_it_anew(
    programs: Programs,
) -> None:
    async with running_device(programs) as rig:
        robot = robot_at(rig)
        await reconnect(robot)
        reader = robot.telemetry()
        await rig.control.unplug()
        async with asyncio.timeout(60.0):
            async for _ in reader:
                pass
        await eventually(lambda: not rig.port.exists())
        with pytest.raises(BoardNotFoundError, match="cannot be opened"):
            await robot.connect()
        resets = (await rig.control.state()).resets
        await rig.control.plug_in()
        await reconnect(robot)
        assert (await rig.control.state()).resets > resets
        await robot.close()


async def test_bytes_at_another_speed_do_not_reach_the_board(programs: Programs) -> None:
    async with running_device(programs) as rig:

        async def has_noticed() -> bool:
            return (await rig.control.statistics()).wrong_baud > 0

        def talk() -> serial.Serial:
            line = serial.Serial(str(rig.port), ANOTHER_SPEED)
            line.write(b"hello\n" * 10)
            line.flush()
            return line

        line = await asyncio.to_thread(talk)
        await eventually(has_noticed, within_s=60.0)
        assert (await rig.control.statistics()).bytes_to_board == 0
        line.close()


@contextmanager
def chattering_device() -> Iterator[Path]:
    """A device that is no motion board: it answers every byte with text."""
    board_side, host_side = pty.openpty()
    tty.setraw(host_side)

    def chatter() -> None:
        while data := os.read(board_side, 256):
            if b"\4" in data:
                return
            os.write(board_side, b"OK\r\n\0" * len(data))

    thread = threading.Thread(target=chatter, daemon=True)
    thread.start()
    try:
        yield Path(os.ttyname(host_side))
    finally:
        os.write(host_side, b"\4")
        thread.join()
        os.close(host_side)
        os.close(board_side)


async def test_another_device_on_the_port_is_no_board() -> None:
    machine = standing_machine()
    with chattering_device() as port:
        robot = ArduinoRobot(str(port), machine.geometry, MotionLimits(), machine.settings)
        with pytest.raises(BoardSilentError, match="not as a motion board does"):
            await robot.connect()
        await robot.close()
