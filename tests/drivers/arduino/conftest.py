"""A fake board on a cable, and the driver for it."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import pytest

from drivers.arduino.driver import ArduinoRobot
from tests.drivers.arduino.driving import robot_at
from tests.support.board_cable import BoardCable, board_cable


@pytest.fixture
def cable(tmp_path: Path) -> Iterator[BoardCable]:
    with board_cable(tmp_path) as cable:
        yield cable


@pytest.fixture
async def robot(cable: BoardCable) -> AsyncIterator[ArduinoRobot]:
    robot = robot_at(cable)
    await robot.connect()
    yield robot
    await robot.close()


@pytest.fixture
async def homed(robot: ArduinoRobot) -> ArduinoRobot:
    await robot.enable()
    await robot.home()
    return robot
