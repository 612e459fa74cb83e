"""Writes one recording: an MCAP file that is readable up to its last chunk at any moment."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import BinaryIO

from mcap.writer import CompressionType, Writer

from server.recordings.topics import TOPICS, Record, Topic
from server.version import VERSION

UNFINISHED = ".part"
"""Ending of a file that is being written, or was when the power went."""


class RecordingFile:
    """A recording under way. All methods block: call them from a worker thread.

    The file has another name while it is written, so that nobody takes it for a whole one.

    Args:
        path: Name of the finished file; its folder exists.

    Raises:
        OSError: the file cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._unfinished = path.with_name(path.name + UNFINISHED)
        self._stream: BinaryIO = self._unfinished.open("wb")
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile="", library=f"PlugPilot {VERSION}")
        self._channels = {topic.name: self._register(topic) for topic in TOPICS}
        self._sequences = dict.fromkeys(self._channels, 0)

    def write(self, topic: Topic, log_time_ns: int, record: Record) -> None:
        """Append a message.

        Raises:
            OSError: the disk refused.
        """
        self._sequences[topic.name] += 1
        self._writer.add_message(
            channel_id=self._channels[topic.name],
            log_time=log_time_ns,
            publish_time=log_time_ns,
            sequence=self._sequences[topic.name],
            data=record.model_dump_json().encode(),
        )

    def flush(self) -> int:
        """Hand everything so far to the system; returns the size of the file [bytes].

        Raises:
            OSError: the disk refused.
        """
        self._writer.flush()  # type: ignore[no-untyped-call]  # the library leaves it out
        return self._stream.tell()

    def finish(self) -> None:
        """Write index and summary, and give the file its name.

        Raises:
            OSError: the disk refused.
        """
        self._writer.finish()  # type: ignore[no-untyped-call]  # the library leaves it out
        self._stream.close()
        self._unfinished.replace(self._path)

    def abandon(self) -> None:
        """Delete what was written."""
        with contextlib.suppress(OSError):  # a full disk refuses the last buffer once more
            self._stream.close()
        self._unfinished.unlink(missing_ok=True)

    def _register(self, topic: Topic) -> int:
        schema = self._writer.register_schema(
            name=topic.schema_name, encoding="jsonschema", data=topic.schema_json
        )
        return self._writer.register_channel(
            topic=topic.name, message_encoding="json", schema_id=schema
        )
