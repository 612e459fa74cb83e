"""The folder of the recordings keeps its limits and survives power cuts."""

from __future__ import annotations

import os
import time
from pathlib import Path
from uuid import UUID

import pytest
from uuid6 import uuid7

from server.config.recordings import MEGABYTE, RecordingSettings
from server.recordings.errors import NoRecordingError, RecordingRunningError
from server.recordings.reader import read_recording
from server.recordings.store import RecordingStore
from server.recordings.topics import EVENT
from tests.server.recordings.test_file import event, numbers, written


def store(folder: Path, **limits: object) -> RecordingStore:
    made = RecordingStore(folder, RecordingSettings.model_validate({"min_free_mb": 0, **limits}))
    made.open()
    return made


def fill(folder: Path, count: int, size_mb: float = 1.0) -> list[str]:
    """Recordings of a size, oldest first."""
    ids = sorted(str(UUID(int=uuid7().int)) for _ in range(count))
    for job_id in ids:
        path = folder / "recordings" / f"{job_id}.mcap"
        path.write_bytes(bytes(round(size_mb * MEGABYTE)))
    return ids


def names(folder: Path) -> list[str]:
    return sorted(path.stem for path in (folder / "recordings").glob("*.mcap"))


def test_the_oldest_go_first_by_number(tmp_path: Path) -> None:
    kept = store(tmp_path, max_count=3)
    ids = fill(tmp_path, 5)
    kept.tidy()
    assert names(tmp_path) == ids[2:]


def test_the_oldest_go_first_by_size_and_take_their_playback_along(tmp_path: Path) -> None:
    kept = store(tmp_path, max_total_mb=3.5)
    ids = fill(tmp_path, 4)
    playback, marks = kept.playback_paths(ids[0])
    playback.write_bytes(b"x")
    marks.write_text("{}")
    kept.tidy()
    assert names(tmp_path) == ids[1:]
    assert not playback.exists()
    assert not marks.exists()


def test_a_recording_under_way_is_neither_shown_nor_deleted(tmp_path: Path) -> None:
    kept = store(tmp_path, max_count=1)
    file = kept.begin("job")
    file.write(EVENT, 0, event(0))
    with pytest.raises(RecordingRunningError):
        kept.path("job")
    fill(tmp_path, 2)
    kept.tidy()
    file.finish()
    kept.ended()
    assert numbers(kept.path("job")) == [0]


def test_without_a_recording_there_is_an_error_that_says_so(tmp_path: Path) -> None:
    with pytest.raises(NoRecordingError):
        store(tmp_path).path("job")
    with pytest.raises(NoRecordingError):
        RecordingStore(None, RecordingSettings()).path("job")
    assert not RecordingStore(tmp_path, RecordingSettings(enabled=False)).enabled


def test_a_nearly_full_disk_is_left_alone(tmp_path: Path) -> None:
    kept = store(tmp_path, min_free_mb=1e6)
    with pytest.raises(OSError, match="MB are free"):
        kept.begin("job")
    assert names(tmp_path) == []


def test_what_a_power_cut_left_is_repaired_at_the_next_start(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    folder.mkdir()
    written(folder / "a.mcap", finish=False)
    written(folder / "b.mcap", finish=False).rename(folder / "b.mcap.cut")
    (folder / "c.mcap.part").write_bytes(b"")
    kept = store(tmp_path)
    assert numbers(kept.path("a")) == list(range(100))
    assert numbers(kept.path("b")) == list(range(100))
    assert sorted(path.name for path in folder.iterdir()) == ["a.mcap", "b.mcap"]


def test_a_recording_goes_on_after_a_restart_and_becomes_one(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    folder.mkdir()
    written(folder / "job.mcap", finish=False)  # a hundred entries, then the power went
    kept = store(tmp_path)
    file = kept.begin("job")
    file.write(EVENT, 0, event(100))  # a clock that has been set back, too
    assert (folder / "job.mcap.earlier").is_file()
    file.finish()
    kept.ended()
    assert numbers(kept.path("job")) == list(range(101))
    times_ns = [entry.log_time_ns for entry in read_recording(kept.path("job"))]
    assert times_ns == sorted(times_ns)
    assert sorted(path.name for path in folder.iterdir()) == ["job.mcap"]


def test_a_power_cut_while_pieces_are_joined_loses_none(tmp_path: Path) -> None:
    folder = tmp_path / "recordings"
    folder.mkdir()
    for name, left in (("a", ".earlier"), ("b", ".earlier")):
        written(folder / f"{name}.mcap").rename(folder / f"{name}.mcap{left}")
    written(folder / "a.mcap")
    (folder / "a.joined.part").write_bytes(b"half of it")
    kept = store(tmp_path)
    assert numbers(kept.path("a")) == [*range(100), *range(100)]
    assert numbers(kept.path("b")) == list(range(100))
    assert sorted(path.name for path in folder.iterdir()) == ["a.mcap", "b.mcap"]


def test_a_recording_that_cannot_go_on_keeps_what_there_was(tmp_path: Path) -> None:
    kept = store(tmp_path)
    [old] = fill(tmp_path, 1)
    before = numbers(kept.path(old))
    kept.begin(old).abandon()  # the disk is full
    kept.ended()
    assert numbers(kept.path(old)) == before


def test_what_is_too_old_goes(tmp_path: Path) -> None:
    kept = store(tmp_path, max_age_days=30)
    ids = fill(tmp_path, 3)
    old_s = time.time() - 31 * 86_400
    os.utime(tmp_path / "recordings" / f"{ids[0]}.mcap", (old_s, old_s))
    kept.tidy()
    assert names(tmp_path) == ids[1:]
