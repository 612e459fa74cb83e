"""JPEG pictures as RTP packets (RFC 2435), as simple network cameras send them."""

from __future__ import annotations

import struct
from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

PAYLOAD_TYPE = 26  # JPEG, by RFC 3551
CLOCK_HZ = 90_000

_LARGEST_PIECE = 1400
_HALF_COLOUR_BOTH_WAYS = 1  # type 1 of RFC 2435: 4:2:0
_TABLES_FOLLOW = 255  # in place of a quality: the quantisation tables are in the packet
_SOURCE = 0x51647A01
_START_OF_SCAN, _TABLES = 0xDA, 0xDB


def rtp_packets(
    picture: NDArray[np.uint8], *, sequence: int, time_s: float, quality: int = 90
) -> Iterator[bytes]:
    """One picture as the packets that carry it.

    Args:
        picture: Blue, green, red, shape (height, width, 3), both multiples of 16.
        sequence: Number of the first packet.
        time_s: When it was taken, by the camera's clock.
        quality: Of the compression.
    """
    height, width = picture.shape[:2]
    encoded = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    tables, scan = _taken_apart(encoded.tobytes())
    timestamp = round(time_s * CLOCK_HZ) % (1 << 32)
    for offset in range(0, len(scan), _LARGEST_PIECE):
        piece = scan[offset : offset + _LARGEST_PIECE]
        last = offset + len(piece) == len(scan)
        number = (sequence + offset // _LARGEST_PIECE) % (1 << 16)
        head = struct.pack(">BBHII", 0x80, PAYLOAD_TYPE | last << 7, number, timestamp, _SOURCE)
        head += struct.pack(
            ">IBBBB", offset, _HALF_COLOUR_BOTH_WAYS, _TABLES_FOLLOW, width // 8, height // 8
        )
        if offset == 0:
            head += struct.pack(">BBH", 0, 0, len(tables)) + tables
        yield head + piece


def _taken_apart(jpeg: bytes) -> tuple[bytes, bytes]:
    """Quantisation tables, 64 bytes each, and the compressed scan without its end marker."""
    tables = b""
    at = 2  # behind the start of the picture
    while True:
        marker, length = jpeg[at + 1], int.from_bytes(jpeg[at + 2 : at + 4])
        segment = jpeg[at + 4 : at + 2 + length]
        at += 2 + length
        if marker == _TABLES:
            tables += b"".join(segment[i + 1 : i + 65] for i in range(0, len(segment), 65))
        if marker == _START_OF_SCAN:
            return tables, jpeg[at:-2]
