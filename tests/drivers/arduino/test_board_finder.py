from __future__ import annotations

from dataclasses import dataclass

import pytest

from drivers.arduino.board_finder import find_board
from drivers.arduino.errors import BoardNotFoundError


@dataclass
class Port:
    device: str
    vid: int | None
    pid: int | None


CH340 = Port("/dev/ttyUSB0", 0x1A86, 0x7523)
MEGA = Port("/dev/ttyACM0", 0x2341, 0x0042)
MODEM = Port("/dev/ttyS0", None, None)


def test_the_only_board_is_found() -> None:
    assert find_board("auto", [MODEM, CH340]) == "/dev/ttyUSB0"
    assert find_board("auto", [MEGA]) == "/dev/ttyACM0"


def test_a_named_port_is_taken_as_it_is() -> None:
    assert find_board("/dev/serial/by-id/robot", [CH340, MEGA]) == "/dev/serial/by-id/robot"


def test_no_board_says_what_to_do() -> None:
    with pytest.raises(BoardNotFoundError, match=r"cable.*robot\.port"):
        find_board("auto", [MODEM])


def test_two_boards_are_not_guessed_between() -> None:
    with pytest.raises(BoardNotFoundError, match=r"ttyACM0, /dev/ttyUSB0.*robot\.port"):
        find_board("auto", [CH340, MEGA])
