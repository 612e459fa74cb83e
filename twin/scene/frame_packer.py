"""Frames that are packed once, however many browsers watch.

viser 1.1.1 turns messages into a frame for each browser anew. Browsers that watch the same robot
get the same messages at the same time, so a frame that was just packed is sent to all of them.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Sequence

import msgspec
import zstandard
from viser.infra import _infra
from viser.infra._messages import Message

_KEPT = 4
"""Frames: a browser that lags behind must not drive out what all others are sent."""
_LEVEL = 1
_LENGTHS = 16


class FramePacker:
    """Packs windows of messages; remembers the newest frames."""

    def __init__(self) -> None:
        self._packer = zstandard.ZstdCompressor(level=_LEVEL)
        self._newest: deque[tuple[Sequence[Message], bytes]] = deque(maxlen=_KEPT)

    def frame(self, window: Sequence[Message]) -> bytes:
        """The frame of a window, the same object for a window of the same messages."""
        for known, frame in reversed(self._newest):
            if len(known) == len(window) and all(
                a is b for a, b in zip(known, window, strict=True)
            ):
                return frame
        frame = self._packed(window)
        self._newest.append((window, frame))
        return frame

    def _packed(self, window: Sequence[Message]) -> bytes:
        """Lengths, packed messages, and their arrays as they are, each at a multiple of 8 bytes."""
        arrays: list[memoryview] = []
        messages = tuple(message.as_serializable_dict(arrays) for message in window)
        inner = msgspec.msgpack.encode(
            {
                "messages": messages,
                "timestampSec": time.perf_counter(),
                "binaryBufferLengths": tuple(array.nbytes for array in arrays),
            }
        )
        packed = self._packer.compress(inner)
        parts: list[bytes | memoryview] = [
            len(inner).to_bytes(8, "little"),
            len(packed).to_bytes(8, "little"),
            packed,
        ]
        _infra._append_aligned_buffers(parts, arrays, _LENGTHS + len(packed))  # noqa: SLF001
        return b"".join(parts)
