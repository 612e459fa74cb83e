"""Frames packed harder on their way to the browser."""

from __future__ import annotations

import numpy as np
import pytest
import zstandard
from hypothesis import given
from hypothesis import strategies as st

from server.api.twin.frames import repacked
from twin.scene import car, plug_parts
from twin.scene.glb import to_glb


def frame_of(messages: bytes, arrays: bytes, level: int = 1) -> bytes:
    packed = zstandard.ZstdCompressor(level=level).compress(messages)
    head = len(messages).to_bytes(8, "little") + len(packed).to_bytes(8, "little") + packed
    return head + bytes(-len(head) % 8) + arrays


def parts_of(frame: bytes) -> tuple[bytes, bytes]:
    """Messages and arrays, read as the browser reads them."""
    size, packed = (int.from_bytes(frame[i : i + 8], "little") for i in (0, 8))
    messages = zstandard.ZstdDecompressor().decompress(
        frame[16 : 16 + packed], max_output_size=size
    )
    return messages, frame[16 + packed + -packed % 8 :]


@given(st.binary(max_size=200), st.binary(max_size=64).map(lambda b: b + bytes(-len(b) % 8)))
def test_nothing_of_it_changes(messages: bytes, arrays: bytes) -> None:
    assert parts_of(repacked(frame_of(messages, arrays))) == (messages, arrays)


def test_a_scene_gets_much_smaller() -> None:
    scene = b"".join(to_glb(parts) for parts in (car.body(-0.17), car.wheel(), plug_parts.plug()))
    before = frame_of(scene, b"12345678")
    after = repacked(before)
    assert parts_of(after) == (scene, b"12345678")
    assert len(after) < 0.85 * len(before)


def test_a_frame_that_gets_no_smaller_is_left_alone() -> None:
    noise = np.random.default_rng(5).bytes(5000)
    before = frame_of(noise, b"", level=19)
    assert repacked(before) is before


@pytest.mark.parametrize(
    "frame",
    [
        b"",
        (5).to_bytes(8, "little") * 2,
        (5).to_bytes(8, "little") * 2 + b"12345",
        (2**63).to_bytes(8, "little") + bytes(8),
    ],
    ids=["empty", "short", "not packed", "huge"],
)
def test_what_is_no_frame_is_passed_on_as_it_is(frame: bytes) -> None:
    assert repacked(frame) is frame
