from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.arduino.link.cobs import CobsError, cobs_decode, cobs_encode
from drivers.arduino.link.crc16 import crc16

RUN = bytes(range(1, 255))


@pytest.mark.parametrize(
    ("data", "encoded"),
    [
        (b"", b"\x01"),
        (b"\0", b"\x01\x01"),
        (b"\0\0", b"\x01\x01\x01"),
        (b"\x11\x22\0\x33", b"\x03\x11\x22\x02\x33"),
        (b"\x11\0\0\0", b"\x02\x11\x01\x01\x01"),
        (RUN, b"\xff" + RUN),
        (RUN + b"\xff", b"\xff" + RUN + b"\x02\xff"),
        (b"\0" + RUN, b"\x01\xff" + RUN),
    ],
)
def test_examples_of_the_paper(data: bytes, encoded: bytes) -> None:
    assert cobs_encode(data) == encoded
    assert cobs_decode(encoded) == data


@given(st.lists(st.sampled_from([0, 1, 2, 254, 255]), max_size=600).map(bytes))
def test_any_bytes_survive_without_zeros(data: bytes) -> None:
    encoded = cobs_encode(data)
    assert 0 not in encoded
    assert len(encoded) <= len(data) + 1 + len(data) // 254
    assert cobs_decode(encoded) == data


@pytest.mark.parametrize("block", [b"\x05\x11", b"\x02", b"\x03\x11\x22\x04\x01", b"\x03\x00\x11"])
def test_what_is_no_encoding_is_an_error(block: bytes) -> None:
    with pytest.raises(CobsError):
        cobs_decode(block)


def test_the_checksum_is_ccitt_false() -> None:
    assert crc16(b"123456789") == 0x29B1
    assert crc16(b"") == 0xFFFF
