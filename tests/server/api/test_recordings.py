"""Recordings over HTTP: whole, in parts, and in 3D."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from datetime import UTC, datetime
from pathlib import Path

import httpx
import pytest
from mcap.reader import make_reader

from server.api.app import PREFIX, create_app
from server.api.gate.caller import COOKIE
from server.composition import running
from server.config.settings import Settings
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Playback
from server.services import Services
from tests.support.api import problem
from tests.support.garage import Scene, on_scene
from tests.support.jobs import job_of
from tests.support.pairing import new_device

NOW = datetime(2026, 3, 1, 18, 4, 5, tzinfo=UTC)
SEED = 4


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A data folder with one recorded job, and the job's id."""
    folder = tmp_path_factory.mktemp("data")

    async def scenario(scene: Scene) -> str:
        job = await scene.carried_out(JobType.PLUG_IN)
        show = scene.services.recordings.show
        await scene.until(lambda: show(job).recording is not None)
        return job.id

    return folder, on_scene(scenario, seed=SEED, folder=folder)


@contextlib.asynccontextmanager
async def client(folder: Path | None) -> AsyncIterator[tuple[httpx.AsyncClient, Services]]:
    """A client in real time: files are sent by threads, for which virtual time would not wait."""
    async with running(Settings(), folder=folder, wait_for_robot=False) as services:
        app = create_app(lambda: contextlib.nullcontext(services))
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(
                transport=transport,
                base_url=f"http://robot{PREFIX}/",
                cookies={COOKIE: await new_device(services.access)},
            ) as http,
        ):
            yield http, services


async def test_a_recording_can_be_downloaded_whole_and_in_parts(
    recorded: tuple[Path, str], tmp_path: Path
) -> None:
    folder, job_id = recorded
    async with client(folder) as (http, _):
        job = (await http.get(f"jobs/{job_id}")).json()
        listed = (await http.get("jobs")).json()["items"][0]
        whole = await http.get(f"jobs/{job_id}/recording")
        part = await http.get(f"jobs/{job_id}/recording", headers={"Range": "bytes=10-19"})
        beyond = await http.get(f"jobs/{job_id}/recording", headers={"Range": "bytes=999999999-"})
    assert whole.status_code == 200
    assert job["recording"] == listed["recording"] == {"size_bytes": len(whole.content)}
    assert "plug_in.mcap" in whole.headers["content-disposition"]
    assert whole.headers["x-content-type-options"] == "nosniff"
    assert part.status_code == 206
    assert part.content == whole.content[10:20]
    assert beyond.status_code == 416
    saved = tmp_path / "a.mcap"
    saved.write_bytes(whole.content)
    with saved.open("rb") as stream:
        topics = {channel.topic for _, channel, _ in make_reader(stream).iter_messages()}
    assert {"/robot/state", "/robot/insertion", "/camera/key", "/job/events"} <= topics


async def test_a_recording_plays_back_and_is_made_only_once(recorded: tuple[Path, str]) -> None:
    folder, job_id = recorded
    async with client(folder) as (http, services):
        first, second = await asyncio.gather(
            http.get(f"jobs/{job_id}/playback", timeout=120),
            http.get(f"jobs/{job_id}/playback.viser", timeout=120),
        )
        made_ns = services.recordings.playback_paths(job_id)[0].stat().st_mtime_ns
        again = await http.get(f"jobs/{job_id}/playback.viser")
        assert services.recordings.playback_paths(job_id)[0].stat().st_mtime_ns == made_ns
    playback = Playback.model_validate(first.json())
    assert 5 < playback.duration_s < 20
    phases = [mark.text for mark in playback.marks if mark.kind == "phase"]
    assert phases == ["preflight", "locating", "aligning", "inserting", "plugged"]
    assert second.content == again.content
    assert 50_000 < len(again.content) < 5_000_000


async def test_without_a_recording_the_answer_says_why(tmp_path: Path) -> None:
    job = job_of(NOW, state=JobState.SUCCEEDED, phase=JobPhase.PARKING)
    async with client(tmp_path) as (http, services):
        await services.jobs.add(job, key=None, digest=None)
        for path in ("recording", "playback", "playback.viser"):
            problem(await http.get(f"jobs/{job.id}/{path}"), 404, "no_recording")
            problem(await http.get(f"jobs/nobody/{path}"), 404, "job_not_found")
        assert (await http.get(f"jobs/{job.id}")).json()["recording"] is None
        broken = services.recordings.playback_paths(job.id)[0].with_suffix(".mcap")
        broken.write_bytes(b"not a recording")
        problem(await http.get(f"jobs/{job.id}/playback", timeout=120), 500, "playback_failed")
        assert not list(broken.parent.glob("*.viser*"))
        services.recordings._running = job.id
        problem(await http.get(f"jobs/{job.id}/recording"), 409, "recording_running")


async def test_nothing_is_kept_in_memory() -> None:
    async with client(None) as (http, _):
        problem(await http.get("jobs/nobody/recording"), 404, "job_not_found")
