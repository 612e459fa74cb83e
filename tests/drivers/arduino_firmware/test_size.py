"""The firmware as the compiler for the board makes it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from drivers.arduino.firmware_size import firmware_size
from tests.drivers.arduino_firmware.conftest import Firmware

LARGEST_SHARE = 0.6
"""The rest of the memory is for the stack, that of the flash for what comes."""


@pytest.mark.skipif(
    shutil.which("avr-g++") is None or not Path("/usr/lib/avr/include/avr/io.h").exists(),
    reason="needs the Debian packages gcc-avr, binutils-avr and avr-libc",
)
def test_the_firmware_leaves_room(firmware: Firmware) -> None:
    said = firmware.make("all")
    size = firmware_size(firmware.build / "firmware.elf")
    assert 0.05 < size.flash_share < LARGEST_SHARE
    assert 0.05 < size.ram_share < LARGEST_SHARE
    # the linker's own sums
    assert f"{size.flash} bytes" in said
    assert f"{size.ram} bytes" in said


def test_what_is_no_firmware_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "firmware.elf"
    path.write_bytes(b"\x7fELF\x01\x01\x01" + bytes(60))
    with pytest.raises(ValueError, match="not for an AVR"):
        firmware_size(path)
    path.write_bytes(b"hex")
    with pytest.raises(ValueError, match="no ELF"):
        firmware_size(path)
