"""Damages frames and counts what a board would take for a command that nobody gave."""

from __future__ import annotations

import random
from dataclasses import dataclass

from drivers.arduino.link.cobs import CobsError, cobs_decode
from drivers.arduino.link.crc16 import crc16
from drivers.arduino.link.frames import Frame, FrameReader, decode_block, encode_frame
from drivers.arduino.link.go_back_n import NUMBERS
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import FROM_HOST

LARGEST_RATE_JUMP = round(0.5 * 226.6 / 20_000 * 2**31)
"""As configured for a carriage: 0.5 mm/s at 226.6 microsteps per mm."""


@dataclass(frozen=True, slots=True)
class CorruptionResult:
    """What became of damaged frames.

    Attributes:
        damaged_frames: How many were damaged so that their bytes changed.
        passed_crc: Of these, how many had a right CRC all the same.
        passed_frame: How many passed all checks of a frame as something else than was sent.
        believed: How many of those a board would have obeyed as another command: outside the
            sequence, or with the expected number and, for a segment, as the queue's continuation.
        deaf_after: How often the frame that followed a damaged one, behind a delimiter as the host
            sends it, was not understood.
    """

    damaged_frames: int
    passed_crc: int
    passed_frame: int
    believed: int
    deaf_after: int


def corruption_campaign(count: int, rng: random.Random) -> CorruptionResult:
    """Send ``count`` frames damaged by 1 to 4 bit flips, cuts or insertions."""
    done = passed_crc = passed_frame = believed = deaf_after = 0
    reader = FrameReader(FROM_HOST)
    while done < count:
        sent = Frame(rng.randrange(NUMBERS), rng.randrange(NUMBERS), _random_command(rng))
        wire = encode_frame(sent)
        damaged = _damage(wire, rng)
        if damaged == wire:
            continue
        done += 1
        following = Frame(done % NUMBERS, 0, messages.Clock(token=done % 65536))
        heard = list(reader.feed(damaged + b"\0" + encode_frame(following)))
        deaf_after += not heard or heard[-1] != following
        for block in damaged.split(b"\0"):
            if block == wire[:-1]:
                continue  # an inserted delimiter at either end: the frame itself is whole
            passed_crc += _crc_is_right(block)
            got = decode_block(block, FROM_HOST)
            if got is not None and got != sent:
                passed_frame += 1
                believed += _would_be_obeyed(got, sent)
    return CorruptionResult(done, passed_crc, passed_frame, believed, deaf_after)


def _random_command(rng: random.Random) -> Message:
    if rng.random() < 0.5:
        kind: type[Message] = messages.Segment  # what travels most
    else:
        kind = messages.MESSAGES[rng.choice(sorted(FROM_HOST))]
    return kind.unpack(rng.randbytes(kind.LAYOUT.size))


def _damage(wire: bytes, rng: random.Random) -> bytes:
    data = bytearray(wire)
    how = rng.randrange(3)
    if how == 0:
        for bit in rng.sample(range(8 * len(data)), rng.randint(1, 4)):
            data[bit // 8] ^= 1 << bit % 8
    elif how == 1:
        start = rng.randrange(len(data))
        del data[start : start + rng.randint(1, 4)]
    else:
        for _ in range(rng.randint(1, 4)):
            data.insert(rng.randrange(len(data)), rng.randrange(256))
    return bytes(data)


def _crc_is_right(block: bytes) -> bool:
    try:
        body = cobs_decode(block)
    except CobsError:
        return False
    return len(body) > 2 and crc16(body[:-2]) == int.from_bytes(body[-2:], "little")


def _would_be_obeyed(got: Frame, sent: Frame) -> bool:
    """Whether a board that waits for the frame that was sent would act on another command."""
    if got.message == sent.message and got.seq == sent.seq:
        return False  # the same command; a board does not act on the ack
    if not got.message.SEQUENCED:
        return True
    if got.seq != sent.seq:
        return False
    if isinstance(got.message, messages.Segment) and isinstance(sent.message, messages.Segment):
        return _continues_alike(got.message, sent.message)
    return True


def _continues_alike(got: messages.Segment, sent: messages.Segment) -> bool:
    """Whether a segment passes the board's check against the end of its queue."""
    same_place = (got.number, got.start, got.phase) == (sent.number, sent.start, sent.phase)
    jumps = [abs(a - b) for a, b in zip(got.rate, sent.rate, strict=True)]
    return same_place and max(jumps) <= LARGEST_RATE_JUMP
