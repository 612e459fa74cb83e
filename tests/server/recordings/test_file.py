"""A recording is readable up to its last chunk, whatever happens to it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from mcap.reader import make_reader

from server.recordings.file import UNFINISHED, RecordingFile
from server.recordings.reader import read_recording, repair
from server.recordings.topics import EVENT, TOPICS, EventRecord

SECOND_NS = 1_000_000_000


def event(number: int) -> EventRecord:
    return EventRecord(
        sequence=number, kind="note", phase="locating", message="word " * 20, data_json="{}"
    )


def written(path: Path, *, chunks: int = 5, per_chunk: int = 20, finish: bool = True) -> Path:
    """A recording of numbered events; returns the file that is there."""
    file = RecordingFile(path)
    for number in range(chunks * per_chunk):
        file.write(EVENT, number * SECOND_NS, event(number))
        if number % per_chunk == per_chunk - 1:
            file.flush()
    if finish:
        file.finish()
        return path
    file._stream.close()
    return path.with_name(path.name + UNFINISHED)


def numbers(path: Path) -> list[int]:
    records = [entry.record for entry in read_recording(path)]
    return [record.sequence for record in records if isinstance(record, EventRecord)]


def test_what_is_written_is_read(tmp_path: Path) -> None:
    assert numbers(written(tmp_path / "a.mcap")) == list(range(100))
    assert not list(tmp_path.glob(f"*{UNFINISHED}"))


def test_the_librarys_own_reader_finds_index_and_schemas(tmp_path: Path) -> None:
    with written(tmp_path / "a.mcap").open("rb") as stream:
        summary = make_reader(stream).get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert summary.statistics.message_count == 100
        assert {channel.topic for channel in summary.channels.values()} == {t.name for t in TOPICS}
        for schema in summary.schemas.values():
            assert schema.encoding == "jsonschema"
            content = json.loads(schema.data)
            assert content["type"] == "object"
            assert "$ref" not in schema.data.decode()


def test_a_file_cut_anywhere_gives_all_whole_chunks(tmp_path: Path) -> None:
    path = written(tmp_path / "a.mcap", finish=False)
    content = path.read_bytes()
    cut = tmp_path / "cut.mcap"
    found = []
    for length in range(8, len(content), 97):
        cut.write_bytes(content[:length])
        read = numbers(cut)
        assert read == list(range(len(read)))
        assert len(read) % 20 == 0
        found.append(len(read))
    assert found == sorted(found)
    assert found[-1] >= 80


def test_garbage_behind_a_cut_is_no_record(tmp_path: Path) -> None:
    path = written(tmp_path / "a.mcap", finish=False)
    content = path.read_bytes()
    path.write_bytes(content[: len(content) * 2 // 3] + os.urandom(5000))
    read = numbers(path)
    assert read == list(range(len(read)))
    assert 20 <= len(read) < 100


def test_a_repaired_recording_is_whole(tmp_path: Path) -> None:
    cut = written(tmp_path / "a.mcap", finish=False)
    content = cut.read_bytes()
    cut.write_bytes(content[: len(content) * 4 // 5])
    kept = len(numbers(cut))
    assert 0 < kept < 100
    moved = cut.replace(tmp_path / "a.mcap.cut")
    assert repair(moved, tmp_path / "a.mcap")
    with (tmp_path / "a.mcap").open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    assert summary.statistics.message_count == kept
    assert [file.name for file in tmp_path.iterdir()] == ["a.mcap"]


def test_an_empty_cut_leaves_nothing(tmp_path: Path) -> None:
    cut = tmp_path / "a.mcap.cut"
    cut.write_bytes(b"\x89MCAP0\r\n")
    assert not repair(cut, tmp_path / "a.mcap")
    assert list(tmp_path.iterdir()) == []


def test_an_abandoned_recording_leaves_nothing(tmp_path: Path) -> None:
    file = RecordingFile(tmp_path / "a.mcap")
    file.write(EVENT, 0, event(0))
    file.abandon()
    assert list(tmp_path.iterdir()) == []


WRITE_FOR_EVER = """
import sys
from pathlib import Path
from server.recordings.file import RecordingFile
from server.recordings.topics import EVENT, EventRecord
file = RecordingFile(Path(sys.argv[1]))
number = 0
while True:
    for _ in range(20):
        record = EventRecord(sequence=number, kind="n", phase="p", message="m", data_json="{}")
        file.write(EVENT, number, record)
        number += 1
    file.flush()
    print(number, flush=True)
"""


def test_a_killed_process_leaves_all_that_it_had_flushed(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with subprocess.Popen(
        [sys.executable, "-c", WRITE_FOR_EVER, str(path)],
        stdout=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[3],
    ) as process:
        assert process.stdout is not None
        flushed = [int(process.stdout.readline()) for _ in range(10)][-1]
        process.send_signal(signal.SIGKILL)
    read = numbers(path.with_name(path.name + UNFINISHED))
    assert read == list(range(len(read)))
    assert len(read) >= flushed


def test_a_file_that_cannot_be_made_says_so(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No such file"):
        RecordingFile(tmp_path / "missing" / "a.mcap")
