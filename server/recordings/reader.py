"""Reads recordings, whole ones and those that a power cut has left behind."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mcap.exceptions import McapError
from mcap.records import Channel, Message
from mcap.stream_reader import CRCValidationError, StreamReader
from zstandard import ZstdError

from server.recordings.file import RecordingFile
from server.recordings.topics import TOPICS, Record, Topic

LARGEST_RECORD_BYTES = 64 * 2**20
"""More is no record of ours but garbage behind a cut."""

CUT_SHORT = (McapError, CRCValidationError, ZstdError, struct.error)
"""What reading raises where the rest was never written. A short read looks like any of these."""

GAP_NS = 1_000_000_000
"""Between two pieces of a recording, at least."""

_BY_NAME = {topic.name: topic for topic in TOPICS}


@dataclass(frozen=True, slots=True)
class Entry:
    """One message of a recording.

    Attributes:
        topic: Where it belongs.
        log_time_ns: When, in nanoseconds since 1970.
        record: The message, checked.
    """

    topic: Topic
    log_time_ns: int
    record: Record


def read_recording(path: Path) -> Iterator[Entry]:
    """All messages in the order in which they were written, as far as the file is readable.

    A file that ends in the middle of a chunk gives all messages of the chunks before.

    Raises:
        OSError: the file cannot be opened.
    """
    topics: dict[int, Topic] = {}
    with path.open("rb") as stream:
        reader = StreamReader(stream, validate_crcs=True, record_size_limit=LARGEST_RECORD_BYTES)
        records = reader.records
        while True:
            try:
                record = next(records, None)
            except CUT_SHORT:
                return
            if record is None:
                return
            if isinstance(record, Channel) and record.topic in _BY_NAME:
                topics[record.id] = _BY_NAME[record.topic]
            elif isinstance(record, Message) and record.channel_id in topics:
                topic = topics[record.channel_id]
                yield Entry(topic, record.log_time, topic.model.model_validate_json(record.data))


def repair(cut: Path, path: Path) -> bool:
    """Make a whole recording of what a power cut has left; False when nothing is in it.

    Args:
        cut: What was left; deleted when it has been read.
        path: The whole recording.

    Raises:
        OSError: the disk refused.
    """
    repaired = RecordingFile(path)
    count = 0
    for count, entry in enumerate(read_recording(cut), start=1):  # noqa: B007 - counts them
        repaired.write(entry.topic, entry.log_time_ns, entry.record)
    if count:
        repaired.finish()
    else:
        repaired.abandon()
    cut.unlink()
    return count > 0


def join(pieces: Sequence[Path], whole: Path) -> None:
    """Make one recording of several of the same job, in their order.

    Times count the robot's own seconds, so those of a fast simulation run ahead of the date; a
    later piece begins no earlier than a second after the one before.

    Args:
        pieces: Recordings; not changed.
        whole: What is made of them.

    Raises:
        OSError: the disk refused; nothing is left of the attempt.
    """
    joined = RecordingFile(whole)
    try:
        end_ns = 0
        for piece in pieces:
            shift_ns: int | None = None
            for entry in read_recording(piece):
                if shift_ns is None:
                    shift_ns = max(0, end_ns + GAP_NS - entry.log_time_ns) if end_ns else 0
                log_time_ns = entry.log_time_ns + shift_ns
                end_ns = max(end_ns, log_time_ns)
                joined.write(entry.topic, log_time_ns, entry.record)
        joined.finish()
    except OSError:
        joined.abandon()
        raise
