"""`plugpilot firmware`: build the firmware, write it into the board, listen to the board."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import serial

from drivers.arduino.board_finder import AUTO, find_board
from drivers.arduino.errors import BoardNotFoundError
from drivers.arduino.firmware_size import FLASH_BYTES, RAM_BYTES, firmware_size
from drivers.arduino.link.frames import FrameReader
from drivers.arduino.listener import BoardListener
from drivers.arduino.protocol.messages import BAUD, MESSAGES
from server.errors import PlugPilotError

SOURCES = Path(__file__).parents[2] / "drivers" / "arduino" / "firmware"

PACKAGES = {
    "make": "make",
    "avr-g++": "gcc-avr",
    "avr-size": "binutils-avr",
    "avrdude": "avrdude",
}
"""What each tool comes with on Debian and Raspberry Pi OS."""

AVR_HEADER = Path("/usr/lib/avr/include/avr/io.h")
FROM_BOARD = frozenset(number for number in MESSAGES if number & 0x80)
READ_S = 0.2


class FirmwareError(PlugPilotError):
    """The firmware could not be built, written or listened to."""

    code = "firmware"
    title = "The firmware could not be built or written"
    remedy = "Mend that and call the command again."


class ToolsMissingError(FirmwareError):
    """Programs that build or write firmware are not installed."""

    code = "firmware_tools_missing"
    title = "Programs are missing"
    remedy = "Install them: sudo apt install make gcc-avr binutils-avr avr-libc avrdude"


@click.group()
def firmware() -> None:
    """Build the motion board's firmware, write it into the board, listen to it."""


@firmware.command()
@click.option(
    "--output",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for what is built.  [a folder `build` beside the sources]",
)
def build(output: Path | None) -> None:
    """Build the firmware and print how much of the chip it takes."""
    _require_tools("make", "avr-g++", "avr-size")
    folder = output or SOURCES / "build"
    _make("all", folder)
    _print_size(folder / "firmware.elf")


@firmware.command()
@click.option("--port", default=AUTO, show_default=True, help="Serial port of the board.")
def flash(port: str) -> None:
    """Build the firmware and write it into the board.

    Stop `plugpilot serve` first: only one program can use the port. Writing resets the board; the
    drives lose their power and the robot has to be homed afterwards.
    """
    _require_tools("make", "avr-g++", "avr-size", "avrdude")
    device = _find(port)
    with tempfile.TemporaryDirectory() as folder:
        _make("flash", Path(folder), f"PORT={device}")
    click.echo(f"The firmware is in the board at {device}.")


@firmware.command()
@click.option("--port", default=AUTO, show_default=True, help="Serial port of the board.")
@click.option("--seconds", type=click.FloatRange(min=0), help="How long.  [until Ctrl+C]")
def monitor(port: str, seconds: float | None) -> None:
    """Print who the board is, then what it sees: state, switches, positions, supply, temperature.

    A new line comes with every change, and every few seconds. The drives stay off. Opening the port
    resets most boards.
    """
    device = _find(port)
    reader = FrameReader(FROM_BOARD)
    listener = BoardListener()
    end_s = None if seconds is None else time.monotonic() + seconds
    try:
        with serial.Serial(device, BAUD, timeout=READ_S) as line:
            while end_s is None or time.monotonic() < end_s:
                for frame in reader.feed(line.read(64)):
                    for words in listener.hear(frame.message):
                        click.echo(words)
                line.write(listener.take_answer())
    except serial.SerialException as error:
        raise FirmwareError(f"{device} cannot be read: {error}.") from error
    except KeyboardInterrupt:
        return


def _print_size(elf: Path) -> None:
    if not elf.exists():
        return  # `make` has said what it did instead
    size = firmware_size(elf)
    click.echo(f"Flash: {size.flash:6} of {FLASH_BYTES} bytes ({size.flash_share:.1%})")
    click.echo(f"RAM:   {size.ram:6} of {RAM_BYTES} bytes ({size.ram_share:.1%}) beside the stack")


def _find(port: str) -> str:
    try:
        return find_board(port)
    except BoardNotFoundError as error:
        raise FirmwareError(str(error)) from error


def _require_tools(*tools: str) -> None:
    """Raise an error that names the packages of all tools that are missing."""
    missing = [PACKAGES[tool] for tool in tools if shutil.which(tool) is None]
    if "avr-g++" in tools and not AVR_HEADER.exists():
        missing.append("avr-libc")
    if missing:
        names = ", ".join(missing)
        raise ToolsMissingError(f"These Debian packages are missing: {names}.")


def _make(target: str, output: Path, *variables: str) -> None:
    """Run make and show what it says.

    Raises:
        FirmwareError: it failed; it has said why.
    """
    command = ["make", "-C", str(SOURCES), target, f"BUILD={output.resolve()}", *variables]
    sys.stdout.flush()
    result = subprocess.run(command, check=False, stdin=subprocess.DEVNULL)  # noqa: S603 - no shell
    if result.returncode != 0:
        raise FirmwareError(f"`make {target}` failed in {SOURCES}; its words are above.")
