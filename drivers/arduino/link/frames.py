"""Frames: what travels between two zero bytes."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from drivers.arduino.link.cobs import CobsError, cobs_decode, cobs_encode
from drivers.arduino.link.crc16 import crc16
from drivers.arduino.protocol.definition import CRC_BYTES, HEADER_BYTES
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import MAX_FRAME_BYTES, MESSAGES

DELIMITER = b"\0"


@dataclass(frozen=True, slots=True)
class Frame:
    """One intact frame.

    Attributes:
        seq: Number of a sequenced message or of an event, else 0.
        ack: Next number the sender of the frame expects.
        message: What it says.
    """

    seq: int
    ack: int
    message: Message


def encode_frame(frame: Frame) -> bytes:
    """The frame as it goes over the wire, delimiter included.

    Raises:
        struct.error: a number of the message does not fit into its field.
    """
    payload = frame.message.pack()
    length = HEADER_BYTES + len(payload) + CRC_BYTES
    body = bytes((length, frame.message.TYPE, frame.seq, frame.ack)) + payload
    return cobs_encode(body + crc16(body).to_bytes(CRC_BYTES, "little")) + DELIMITER


def decode_block(block: bytes, accepted: Collection[int]) -> Frame | None:
    """The frame in the bytes before a delimiter; None if it is damaged in any way.

    Args:
        block: Encoded bytes, without the delimiter.
        accepted: Types that the other side may send.
    """
    try:
        body = cobs_decode(block)
    except CobsError:
        return None
    if len(body) < HEADER_BYTES + CRC_BYTES or body[0] != len(body):
        return None
    kind = MESSAGES.get(body[1])
    if kind is None or kind.TYPE not in accepted:
        return None
    payload = body[HEADER_BYTES:-CRC_BYTES]
    if len(payload) != kind.LAYOUT.size:
        return None
    if crc16(body[:-CRC_BYTES]) != int.from_bytes(body[-CRC_BYTES:], "little"):
        return None
    return Frame(seq=body[2], ack=body[3], message=kind.unpack(payload))


class FrameReader:
    """Finds the intact frames in a stream of bytes.

    Args:
        accepted: Types that the other side may send; others count as damaged.
    """

    def __init__(self, accepted: Collection[int]) -> None:
        self.damaged = 0
        self._accepted = accepted
        self._block = bytearray()
        self._too_long = False

    def feed(self, data: bytes) -> Iterator[Frame]:
        """Take bytes as they come and hand out the frames that they complete."""
        *ends, rest = data.split(DELIMITER)
        for end in ends:
            self._collect(end)
            frame = self._finish()
            if frame is not None:
                yield frame
        self._collect(rest)

    def _collect(self, data: bytes) -> None:
        self._block += data
        if len(self._block) >= MAX_FRAME_BYTES:
            # No frame is that long: wait for the next delimiter instead of filling the memory.
            self._too_long = True
            self._block.clear()

    def _finish(self) -> Frame | None:
        block, too_long = bytes(self._block), self._too_long
        self._block.clear()
        self._too_long = False
        if not block and not too_long:
            return None  # extra delimiters are allowed
        frame = None if too_long else decode_block(block, self._accepted)
        if frame is None:
            self.damaged += 1
        return frame
