"""CRC-16-CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected."""

from __future__ import annotations

import binascii

START = 0xFFFF


def crc16(data: bytes) -> int:
    """Checksum of some bytes; 0x29B1 for ``b"123456789"``."""
    return binascii.crc_hqx(data, START)
