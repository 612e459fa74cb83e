from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.arduino.link.cobs import cobs_encode
from drivers.arduino.link.crc16 import crc16
from drivers.arduino.link.frames import Frame, FrameReader, decode_block, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import FROM_BOARD, FROM_HOST, MAX_FRAME_BYTES, MESSAGES
from tests.drivers.arduino.strategies import any_frames
from tests.support.link_corruption import corruption_campaign

STOP = Frame(0, 0, messages.Stop(category=2, token=7))


def raw_block(body: bytes) -> bytes:
    return cobs_encode(body + crc16(body).to_bytes(2, "little"))


@given(any_frames())
def test_a_frame_survives_the_wire(frame: Frame) -> None:
    wire = encode_frame(frame)
    assert len(wire) <= MAX_FRAME_BYTES
    assert wire.count(0) == 1
    assert decode_block(wire[:-1], MESSAGES) == frame


@given(st.lists(any_frames(), max_size=5), st.data())
def test_frames_are_found_however_the_bytes_arrive(
    frames: list[Frame], data: st.DataObject
) -> None:
    stream = b"\0".join(encode_frame(frame) for frame in frames)
    reader = FrameReader(MESSAGES)
    found: list[Frame] = []
    while stream:
        size = data.draw(st.integers(1, len(stream)))
        found += reader.feed(stream[:size])
        stream = stream[size:]
    assert found == frames
    assert reader.damaged == 0


@given(st.binary(max_size=200), any_frames())
def test_a_delimiter_ends_any_noise(noise: bytes, frame: Frame) -> None:
    reader = FrameReader(MESSAGES)
    assert frame in list(reader.feed(noise + b"\0" + encode_frame(frame)))


@pytest.mark.parametrize(
    "body",
    [
        bytes((8, 0x04, 0, 0, 2)),  # length says more than there is
        bytes((7, 0x04, 0, 0, 2)),  # payload too short for a stop
        bytes((9, 0x04, 0, 0, 2, 7, 0)),  # and too long
        bytes((8, 0x7F, 0, 0, 2, 7)),  # unknown type
        bytes((8, 0x83, 0, 0, 2, 7)),  # a type of the board
        b"\x04\x02",
    ],
)
def test_a_good_checksum_alone_is_not_enough(body: bytes) -> None:
    assert decode_block(raw_block(body), FROM_HOST) is None


def test_the_side_that_sends_matters() -> None:
    wire = encode_frame(STOP)[:-1]
    assert decode_block(wire, FROM_HOST) == STOP
    assert decode_block(wire, FROM_BOARD) is None


def test_a_flood_without_delimiter_is_dropped_and_counted_once() -> None:
    reader = FrameReader(FROM_HOST)
    for _ in range(1000):
        assert not list(reader.feed(b"\x55" * 100))
    assert len(reader._block) < MAX_FRAME_BYTES
    assert list(reader.feed(b"\0" + encode_frame(STOP))) == [STOP]
    assert reader.damaged == 1


def test_no_damaged_frame_becomes_another_command() -> None:
    result = corruption_campaign(100_000, random.Random(20_26))
    assert result.damaged_frames == 100_000
    assert result.believed == 0, result
    assert result.deaf_after == 0, "the link recovers every time"
    assert result.passed_crc < 50
