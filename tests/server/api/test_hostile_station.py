"""A station that hangs, or is no station at all, behind the whole server: bounded waits, words."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator

import httpx
import pytest

from drivers.station.settings import OpenevseSettings
from server.api.app import PREFIX, create_app
from server.api.gate.caller import COOKIE
from server.composition import running
from server.config.settings import Settings
from server.config.station import StationSettings
from server.services import Services
from tests.support.api import problem
from tests.support.eventually import eventually
from tests.support.fake_stations.serving import answering, http
from tests.support.pairing import new_device

ANSWERS = {
    "a web page": http(b"<!doctype html><title>Router login</title>", kind="text/html"),
    "half of an answer": http(b'{"state": 1', length=400),
    "a lie": http(b'{"state": 77, "status": "active", "vehicle": 0}'),
    "silence": None,
}
BOUND_S = 20.0
"""For anything that has to ask the station, on a machine that is busy with other tests."""


@contextlib.asynccontextmanager
async def server_with(url: str) -> AsyncIterator[tuple[Services, httpx.AsyncClient]]:
    """The simulated robot with a real station driver, in real time."""
    openevse = OpenevseSettings(url=url, timeout_s=0.3, push=False)
    settings = Settings(station=StationSettings(driver="openevse", openevse=openevse))
    async with running(settings, folder=None) as services:
        app = create_app(lambda: contextlib.nullcontext(services))
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(
                transport=httpx.ASGITransport(app),
                base_url=f"http://plugpilot{PREFIX}/",
                cookies={COOKIE: await new_device(services.access)},
            ) as client,
        ):
            yield services, client


@pytest.mark.parametrize("answer", ANSWERS.values(), ids=ANSWERS.keys())
async def test_the_robot_stays_where_it_is_and_everyone_is_told(answer: bytes | None) -> None:
    async with answering(answer) as url, server_with(url) as (services, client):
        async with asyncio.timeout(BOUND_S):
            assert (await client.get("station")).json()["online"] is False
            health = (await client.get("health")).json()
            assert health["components"]["station"]["status"] == "down"
            charger = (await client.get("charge-point")).json()
            assert (charger["cp_state"], charger["power_w"]) == ("E", 0.0)
            before = services.supervisor.telemetry.require().measured.position
            made = await client.put("charge-point/enabled", json={"enabled": True})
            assert made.status_code == 200, made.text

            async def refused() -> bool:
                (job,) = (await client.get("jobs")).json()["items"]
                return job["state"] == "failed" or job["needs_person"] is not None

            await eventually(refused, within_s=BOUND_S)
            (job,) = (await client.get("jobs")).json()["items"]
            assert job["phase"] == "preflight"
            assert job["error"]["code"] == "station_unsafe"
            assert job["error"]["remedy"]
            assert services.supervisor.telemetry.require().measured.position == before
            assert (
                await client.put("charge-point/max-current", json={"max_current_a": 10})
            ).json()["code"] == "station_unsafe"
            assert (await client.post("robot/stop")).json()["mode"] == "stopped"


async def test_two_commanders_get_one_robot() -> None:
    """Whoever comes second is told who has it; a stop needs nobody's leave."""
    async with answering(http(b"{}")) as url, server_with(url) as (services, client):
        lease = services.supervisor.acquire("jog", "Anna with her phone")
        made = await client.put("charge-point/enabled", json={"enabled": True})
        document = problem(made, 409, "control_busy")
        assert "Anna with her phone" in document["detail"]
        problem(await client.post("jobs", json={"type": "plug_in"}), 409, "control_busy")
        assert (await client.get("charge-point")).json()["enabled"] is False
        services.supervisor.give_back(lease)
        assert (await client.post("robot/estop")).status_code == 200
