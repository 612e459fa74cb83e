"""Frames of the 3D library, packed better than it packs them itself.

A frame is the length of its messages, the length of them packed, the packed messages (zstd),
zeros up to a multiple of 8 bytes, and raw arrays that start there. The library packs as fast as
it can, which is right for poses. The first view of a scene is a third smaller with a little more
effort, and a phone on a mobile network waits for every byte of it.
"""

from __future__ import annotations

import zstandard

WORTHWHILE_BYTES = 16 * 1024
"""Smaller frames are passed on as they are."""

_LENGTHS = 16
_ALIGNED_TO = 8
_LEVEL = 6
_LARGEST_BYTES = 64 * 1024 * 1024


def repacked(frame: bytes) -> bytes:
    """The same frame with its messages packed harder.

    The browser is the one to judge frames: what makes no sense here, or gets no smaller, is
    passed on as it is.
    """
    size, packed = (int.from_bytes(frame[i : i + 8], "little") for i in (0, 8))
    end = _LENGTHS + packed
    if len(frame) < end or size > _LARGEST_BYTES:
        return frame
    try:
        messages = zstandard.ZstdDecompressor().decompress(
            frame[_LENGTHS:end], max_output_size=size
        )
    except zstandard.ZstdError:
        return frame
    harder = zstandard.ZstdCompressor(level=_LEVEL).compress(messages)
    if len(harder) >= packed:
        return frame
    head = frame[:8] + len(harder).to_bytes(8, "little") + harder
    arrays = frame[end + -end % _ALIGNED_TO :]
    return head + bytes(-len(head) % _ALIGNED_TO) + arrays if arrays else head
