"""Consistent Overhead Byte Stuffing: bytes without zeros, so that a zero can end every frame.

S. Cheshire, M. Baker, "Consistent Overhead Byte Stuffing", SIGCOMM 1997.
"""

from __future__ import annotations

LONGEST_RUN = 254
"""Bytes that one code byte can announce."""


class CobsError(ValueError):
    """The bytes are no COBS encoding."""


def cobs_encode(data: bytes) -> bytes:
    """Encode without the delimiter."""
    out = bytearray()
    groups = data.split(b"\0")
    for last, group in ((i == len(groups) - 1, group) for i, group in enumerate(groups)):
        rest = group
        while len(rest) >= LONGEST_RUN:
            out.append(LONGEST_RUN + 1)
            out += rest[:LONGEST_RUN]
            rest = rest[LONGEST_RUN:]
            if last and not rest:
                return bytes(out)
        out.append(len(rest) + 1)
        out += rest
    return bytes(out)


def cobs_decode(block: bytes) -> bytes:
    """Decode what stood before a delimiter.

    Raises:
        CobsError: it contains a zero, or ends before what it announces.
    """
    out = bytearray()
    at = 0
    while at < len(block):
        code = block[at]
        end = at + code
        run = block[at + 1 : end]
        if code == 0 or 0 in run:
            raise CobsError("a zero within a frame")
        if end > len(block):
            raise CobsError("the frame ends too early")
        out += run
        at = end
        if code <= LONGEST_RUN and at < len(block):
            out.append(0)
    return bytes(out)
