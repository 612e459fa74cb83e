"""How much of the chip a built firmware takes, read from its ELF file."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

FLASH_BYTES = 253_952
"""Of the ATmega2560: 256 KiB less the 8 KiB of the boot loader."""

RAM_BYTES = 8_192

_HEADER = struct.Struct("<16x2xHIIIIIHHHHHH")
_AVR = 83
_SECTION = struct.Struct("<IIIIIIIIII")
_HAS_NO_BYTES = 8
_ALLOCATED = 2
_RAM_FROM = 0x800000
"""avr-gcc places memory here, and the EEPROM behind it."""
_RAM_TO = 0x810000


@dataclass(frozen=True, slots=True)
class FirmwareSize:
    """Bytes of a firmware.

    Attributes:
        flash: Program and the first values of variables.
        ram: Variables; the stack takes a part of the rest.
    """

    flash: int
    ram: int

    @property
    def flash_share(self) -> float:
        """Of the flash."""
        return self.flash / FLASH_BYTES

    @property
    def ram_share(self) -> float:
        """Of the memory."""
        return self.ram / RAM_BYTES


def firmware_size(elf: Path) -> FirmwareSize:
    """Measure a firmware.

    Raises:
        ValueError: the file is no firmware for an AVR.
    """
    data = elf.read_bytes()
    if len(data) < _HEADER.size or data[:4] != b"\x7fELF":
        raise ValueError(f"{elf} is no ELF file")
    machine, _, _, _, at, _, _, _, _, size, count, _ = _HEADER.unpack_from(data)
    if machine != _AVR:
        raise ValueError(f"{elf} is not for an AVR")
    flash = ram = 0
    for number in range(count):
        _, kind, flags, address, _, length, _, _, _, _ = _SECTION.unpack_from(
            data, at + number * size
        )
        if not flags & _ALLOCATED:
            continue
        in_ram = _RAM_FROM <= address < _RAM_TO
        ram += length if in_ram else 0
        if address < _RAM_FROM or (in_ram and kind != _HAS_NO_BYTES):
            flash += length
    return FirmwareSize(flash, ram)
