from __future__ import annotations

import struct

import pytest
from hypothesis import given

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from tests.drivers.arduino.strategies import any_messages


@given(any_messages())
def test_a_message_survives_the_wire(message: Message) -> None:
    payload = message.pack()
    assert len(payload) == message.LAYOUT.size
    assert type(message).unpack(payload) == message


def test_integers_are_little_endian_and_in_order() -> None:
    hello = messages.HelloRequest(protocol_hash=0x11223344, session=0x5566)
    assert hello.pack() == bytes.fromhex("44332211 6655")


def test_arrays_lie_side_by_side() -> None:
    segment = messages.Segment(1, 2, (3, -1, 5), (6, 7, 8), (9, 10, 11), (12, 13, -2))
    payload = segment.pack()
    assert payload[4:12] == bytes.fromhex("03000000 ffffffff")
    assert payload[-4:] == bytes.fromhex("feffffff")


def test_a_number_that_does_not_fit_is_an_error() -> None:
    with pytest.raises(struct.error):
        messages.ForceLimit(force_dn=70_000).pack()
