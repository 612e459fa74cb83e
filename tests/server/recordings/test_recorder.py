"""Jobs are recorded as they happen; a disk that fails or is slow holds no job up."""

from __future__ import annotations

import asyncio
import base64
import errno
import json
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import TypeVar

import cv2
import numpy as np
import pytest

from server.config.recordings import RecordingSettings
from server.config.settings import Settings
from server.jobs.model import JobPhase, JobState, JobType
from server.recordings.file import UNFINISHED, RecordingFile
from server.recordings.reader import Entry, read_recording
from server.recordings.session import WAITING, RecordingSession
from server.recordings.timeline import timeline
from server.recordings.topics import (
    END,
    EVENT,
    PICTURE,
    ROBOT,
    DivergenceRecord,
    EndRecord,
    EventRecord,
    HeaderRecord,
    InsertionRecord,
    PictureRecord,
    RobotRecord,
    SocketRecord,
    StationRecord,
)
from server.schema.jobs import Job
from tests.server.recordings.test_file import event
from tests.support.garage import Scene, on_scene
from tests.support.virtual import run_virtual

T = TypeVar("T")


def with_limits(**limits: object) -> Settings:
    recordings = RecordingSettings.model_validate({"min_free_mb": 0, **limits})
    return Settings(recordings=recordings)


def recorded(folder: Path, job: Job) -> list[Entry]:
    return list(read_recording(folder / "recordings" / f"{job.id}.mcap"))


async def until_recorded(scene: Scene, job: Job) -> Job:
    shown = scene.services.recordings.show
    await scene.until(lambda: shown(job).recording is not None)
    return shown(job)


def of(entries: list[Entry], kind: type[T]) -> list[T]:
    return [entry.record for entry in entries if isinstance(entry.record, kind)]


def test_a_whole_job_is_in_its_recording(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.CHARGE, 20.0)
        shown = await until_recorded(scene, job)
        entries = recorded(tmp_path, job)
        assert shown.recording is not None
        assert shown.recording.size_bytes > 100_000

        [header] = of(entries, HeaderRecord)
        assert header.job_id == job.id
        assert json.loads(header.config_json)["geometry"]["leg_length_mm"] == 532
        assert "server" not in json.loads(header.config_json)

        journal = await scene.events(job)
        events = of(entries, EventRecord)
        assert [each.sequence for each in events] == [each.sequence for each in journal]
        begun = [each.phase for each in events if each.kind == "phase_started"]
        assert begun == [phase.value for phase in JobPhase]

        insertion = of(entries, InsertionRecord)
        deep = [each for each in insertion if each.depth_mm > 36 and each.expected_n > 0]
        assert max(each.force_n for each in deep) == pytest.approx(job.result.max_force_n, abs=4)
        assert all(each.low_n < each.force_n < each.high_n + 5 for each in deep)

        sockets = of(entries, SocketRecord)
        assert len(sockets) > 3
        assert np.array(sockets[-1].covariance_mm2).reshape(3, 3)[0, 0] > 0
        powers_w = [each.power_w for each in of(entries, StationRecord)]
        assert max(powers_w) > 3000
        assert of(entries, DivergenceRecord) == []
        assert of(entries, EndRecord) == entries_end(entries)

    on_scene(scenario, seed=2, folder=tmp_path, settings=with_limits())


def entries_end(entries: list[Entry]) -> list[EndRecord]:
    """The last message closes the recording, and nothing was left out because of the disk."""
    last = entries[-1].record
    assert isinstance(last, EndRecord)
    assert last.dropped == 0
    return [last]


def test_times_are_the_robots_own_and_motion_is_dense(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        await until_recorded(scene, job)
        samples = [e for e in recorded(tmp_path, job) if isinstance(e.record, RobotRecord)]
        times_s = np.array([each.log_time_ns for each in samples]) / 1e9
        length_s = times_s[-1] - times_s[0]
        assert job.result.plugged_after_s is not None
        assert length_s == pytest.approx(job.result.plugged_after_s, abs=0.5)
        assert np.median(np.diff(times_s)) == pytest.approx(0.01, abs=1e-4)
        began = samples[0].log_time_ns / 1e9
        assert began == pytest.approx(job.created_at.timestamp(), abs=1.0)

    on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits())


def test_pictures_are_few_and_open(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        await until_recorded(scene, job)
        entries = recorded(tmp_path, job)
        pictures = of(entries, PictureRecord)
        assert len(pictures) == 3
        for each in pictures:
            raw = np.frombuffer(base64.b64decode(each.data), np.uint8)
            picture = cv2.imdecode(raw, cv2.IMREAD_GRAYSCALE)
            assert picture is not None
            assert picture.shape[1] == scene.services.settings.camera.optics.width
        left_out = of(entries, EndRecord)[0].pictures_left_out
        assert left_out == len(of(entries, SocketRecord)) - 3

    on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits(pictures=3))


class FullDisk:
    """Lets some writes through, then refuses all others."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, writes: int) -> None:
        self.left = writes
        original = RecordingFile.flush

        def flush(file: RecordingFile) -> int:
            self.left -= 1
            if self.left < 0:
                raise OSError(errno.ENOSPC, "No space left on device")
            return original(file)

        monkeypatch.setattr(RecordingFile, "flush", flush)


def test_on_a_full_disk_the_job_goes_on_and_its_journal_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    FullDisk(monkeypatch, writes=2)

    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED
        [note] = [e for e in await scene.events(job) if e.kind == "recording_failed"]
        assert note.message == "This job is not recorded: No space left on device."
        assert list((tmp_path / "recordings").iterdir()) == []
        assert scene.services.recordings.show(job).recording is None
        monkeypatch.undo()
        again = await scene.carried_out(JobType.UNPLUG)
        await until_recorded(scene, again)

    on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits())


def test_a_recording_that_grows_too_large_ends_before_its_job(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED
        assert "recording_full" in await scene.kinds(job)
        entries = recorded(tmp_path, job)
        assert isinstance(entries[-1].record, EndRecord)
        phases = {each.phase for each in of(entries, EventRecord)}
        assert "locating" in phases
        assert "plugged" not in phases

    on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits(max_one_mb=0.3))


def test_without_recordings_nothing_is_written(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED
        assert not (tmp_path / "recordings").exists()

    on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits(enabled=False))


def test_an_interrupted_job_leaves_a_whole_recording(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> Job:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        return job

    job = on_scene(scenario, seed=4, folder=tmp_path, settings=with_limits())
    entries = recorded(tmp_path, job)
    assert isinstance(entries[-1].record, EndRecord)
    assert not list((tmp_path / "recordings").glob(f"*{UNFINISHED}"))


def test_a_job_that_spans_a_restart_is_recorded_whole(tmp_path: Path) -> None:
    async def before(scene: Scene) -> Job:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.later(2.0)
        return job

    job = on_scene(before, seed=4, folder=tmp_path, settings=with_limits())

    async def after(scene: Scene) -> None:
        assert (await scene.ended(job)).state is JobState.SUCCEEDED
        await until_recorded(scene, job)
        await scene.later(1.0)
        entries = recorded(tmp_path, job)
        events = of(entries, EventRecord)
        journal = await scene.events(job)
        assert [each.sequence for each in events] == [each.sequence for each in journal]
        times_ns = [each.log_time_ns for each in entries if isinstance(each.record, EventRecord)]
        assert times_ns == sorted(times_ns)
        reel = timeline(entries, rate_hz=20.0, pause_s=2.0)
        phases = [mark.text for mark in reel.marks if mark.kind == "phase"]
        assert phases.count("inserting") == 2
        assert phases[-1] == "plugged"
        assert len(of(entries, StationRecord)) > 10
        assert len(of(entries, PictureRecord)) > 3

    on_scene(after, seed=4, folder=tmp_path, settings=with_limits(), parked=False)


def in_session(tmp_path: Path, scenario: Callable[[RecordingSession, Path], object]) -> list[Entry]:
    """Put messages into a session before its task gets a turn; return what is in the file."""
    path = tmp_path / "a.mcap"

    async def main() -> None:
        session = RecordingSession(
            lambda: RecordingFile(path),
            began_at=datetime(2026, 3, 1, tzinfo=UTC),
            began_s=asyncio.get_running_loop().time(),
            largest_mb=10,
        )
        scenario(session, path)
        session.end()
        assert await session.write(lambda: 0) is None

    run_virtual(main())
    return list(read_recording(path))


def test_a_disk_that_is_too_slow_costs_messages_and_they_are_counted(tmp_path: Path) -> None:
    def flood(session: RecordingSession, _: Path) -> None:
        for number in range(WAITING + 7):
            session.put(EVENT, number * 0.01, lambda n=number: event(n))  # type: ignore[misc]

    entries = in_session(tmp_path, flood)
    events = of(entries, EventRecord)
    assert [each.sequence for each in events] == list(range(WAITING))
    assert of(entries, EndRecord)[0].dropped == 7
    assert entries[-1].topic is END


def test_a_message_that_cannot_be_made_ends_the_recording_but_nothing_else(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    def fail() -> EventRecord:
        raise ValueError("broken")

    async def main() -> str | None:
        session = RecordingSession(
            lambda: RecordingFile(tmp_path / "a.mcap"),
            began_at=datetime(2026, 3, 1, tzinfo=UTC),
            began_s=0.0,
            largest_mb=10,
        )
        session.put(ROBOT, 0.0, fail)
        session.put(PICTURE, 0.0, lambda: None)
        return await session.write(lambda: 0)

    assert run_virtual(main()) == "something went wrong; the log has the details"
    assert "broken" in caplog.text
    assert list(tmp_path.iterdir()) == []
