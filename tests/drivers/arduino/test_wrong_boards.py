"""What is at the other end of the port, if it is not the right board; and what the driver says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from drivers.arduino import handshake
from drivers.arduino.errors import BoardSilentError, WrongFirmwareError
from drivers.arduino.handshake import FIRMWARE_VERSION
from tests.drivers.arduino.driving import robot_at
from tests.support.board_cable import BoardCable, board_cable
from tests.support.fake_board import FakeBoard

VERSION_HEADER = Path(handshake.__file__).parent / "firmware" / "core" / "version.hpp"


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(handshake, "BOOT_S", 0.05)
    monkeypatch.setattr(handshake, "ANSWER_S", 0.2)


def test_the_driver_knows_the_version_of_the_firmware_beside_it() -> None:
    numbers = re.findall(r"kFirmware\w+ = (\d+);", VERSION_HEADER.read_text(encoding="utf-8"))
    assert tuple(map(int, numbers)) == FIRMWARE_VERSION


@pytest.mark.usefixtures("impatient")
async def test_a_silent_port(cable: BoardCable) -> None:
    cable.change(lambda board: setattr(board, "mute", True))
    with pytest.raises(BoardSilentError, match="no motion board answers") as caught:
        await robot_at(cable).connect()
    assert caught.value.code == "board_silent"


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    "noise",
    [b"NMEA: $GPGGA,1,2*7F\r\n", bytes(range(1, 255)), b"\x00\xf8\x80\x00\xe6\x00\x9e"],
    ids=["another device", "one long frame", "another baud rate"],
)
async def test_a_port_that_talks_nonsense(cable: BoardCable, noise: bytes) -> None:
    def talk(board: FakeBoard) -> None:
        board.mute = True
        board.chatter = noise

    cable.change(talk)
    with pytest.raises(BoardSilentError, match="not as a motion board does") as caught:
        await robot_at(cable).connect()
    assert caught.value.code == "board_silent"


@pytest.mark.usefixtures("impatient")
async def test_a_port_that_only_echoes(cable: BoardCable) -> None:
    def echo(board: FakeBoard) -> None:
        board.mute = board.echo = True

    cable.change(echo)
    with pytest.raises(BoardSilentError, match="not as a motion board does"):
        await robot_at(cable).connect()


@pytest.mark.parametrize(
    ("version", "words"),
    [
        ((0, 1, 9), r"firmware 0\.1\.9 is older than this program"),
        ((0, 2, 1), r"firmware 0\.2\.1 is newer than this program"),
        (FIRMWARE_VERSION, r"has the version of this program"),
    ],
)
async def test_firmware_that_speaks_another_version(
    tmp_path: Path, version: tuple[int, int, int], words: str
) -> None:
    with board_cable(tmp_path, protocol_hash=0x1234ABCD) as cable:
        cable.change(lambda board: setattr(board, "version", version))
        with pytest.raises(WrongFirmwareError, match=rf"{words}.*1234ABCD.*Flash") as caught:
            await robot_at(cable).connect()
        assert caught.value.code == "wrong_firmware"
        assert not cable.board.heard, "the board was told nothing in a language it does not know"


async def test_other_firmware_with_the_same_protocol_works(cable: BoardCable) -> None:
    cable.change(lambda board: setattr(board, "version", (9, 9, 9)))
    robot = robot_at(cable)
    assert (await robot.connect()).firmware == "9.9.9"
    await robot.close()
