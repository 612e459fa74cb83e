from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Any

import pytest
from fastapi import FastAPI, Request, Response

from drivers.station import (
    PilotState,
    StationAnswerError,
    StationLoginError,
    StationUnsupportedError,
)
from drivers.station.http import HttpStation
from drivers.station.settings import HttpSettings
from tests.support.fake_stations.serving import serving

SETTINGS: dict[str, Any] = {
    "name": "Workshop",
    "login": "bearer",
    "password": "token-17",
    "status": "/v2/state",
    "pilot": {"path": "evse.pilot", "states": {"1": "A", "2": "B", "3": "C"}},
    "currents": [{"path": "phases[0].ma", "factor": 0.001}, {"path": "phases[1].ma"}],
    "power": {"path": "kw", "factor": 1000},
    "enabled": "evse.on",
    "locked": "latch",
    "start": {"path": "/v2/switch", "method": "PUT", "body": '{"on": true}'},
    "stop": {"path": "/v2/switch", "method": "PUT", "body": '{"on": false}'},
    "unlock": {"path": "/v2/unlock"},
    "timeout_s": 3.0,
}


class Workshop:
    def __init__(self) -> None:
        self.state: dict[str, Any] = {
            "evse": {"pilot": 3, "on": True},
            "phases": [{"ma": 16000}, {"ma": 0}],
            "kw": 3.68,
            "latch": 1,
        }
        self.app = FastAPI()

        @self.app.get("/v2/state")
        async def state(request: Request) -> Any:  # noqa: ANN401 - whatever a test wants
            if request.headers.get("authorization") != "Bearer token-17":
                return Response(status_code=403)
            return self.state

        @self.app.put("/v2/switch")
        async def switch(request: Request) -> None:
            on = (await request.json())["on"]
            self.state["evse"] = {"pilot": 3 if on else 2, "on": on}
            self.state["phases"][0]["ma"] = 16000 if on else 0

        @self.app.post("/v2/unlock")
        async def unlock() -> None:
            self.state["latch"] = 0


@pytest.fixture
def workshop() -> Workshop:
    return Workshop()


@pytest.fixture
async def url(workshop: Workshop) -> AsyncIterator[str]:
    async with serving(workshop.app) as url:
        yield url


@pytest.fixture
async def station(url: str) -> AsyncIterator[HttpStation]:
    station = HttpStation(HttpSettings.model_validate({**SETTINGS, "url": url}))
    await station.open()
    yield station
    await station.close()


async def test_a_station_described_by_configuration(station: HttpStation) -> None:
    charging = await station.snapshot()
    assert (charging.pilot, charging.enabled, charging.contactor_closed) == (
        PilotState.C,
        True,
        True,
    )
    assert charging.currents_a == (16.0, 0.0, 0.0)
    assert charging.power_w == pytest.approx(3680.0)
    assert charging.connector_locked is True
    await station.stop()
    await station.unlock()
    stopped = await station.snapshot()
    assert (stopped.pilot, stopped.enabled, stopped.carries_load) == (PilotState.B, False, False)
    assert stopped.connector_locked is False
    await station.start()
    assert (await station.snapshot()).carries_load
    assert station.capabilities.unlocks
    assert not station.capabilities.holds


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"evse": {"pilot": 4, "on": True}}, "pilot.states"),
        ({"evse": {"pilot": None, "on": True}}, "evse.pilot"),
        ({"evse": [3]}, "evse"),
        ({"evse": {"pilot": 3, "on": "yes"}}, "evse.on"),
        ({"phases": []}, r"phases\[0\]"),
        ({"phases": [{"ma": True}, {"ma": 0}]}, "ma"),
        ({"kw": 10**400}, "kw"),
        ({"kw": "3.68"}, "kw"),
        ({"latch": 2}, "latch"),
    ],
)
async def test_an_answer_that_does_not_fit_is_no_reading(
    station: HttpStation, workshop: Workshop, change: dict[str, Any], place: str
) -> None:
    workshop.state |= change
    with pytest.raises(StationAnswerError, match=place):
        await station.snapshot()


async def test_a_wrong_token_is_told(url: str) -> None:
    settings = {**SETTINGS, "url": url, "password": "token-18"}
    station = HttpStation(HttpSettings.model_validate(settings))
    with pytest.raises(StationLoginError):
        await station.open()
    await station.close()


async def test_without_commands_it_only_reads(url: str) -> None:
    settings = {k: v for k, v in SETTINGS.items() if k not in {"start", "stop", "unlock"}}
    station = HttpStation(HttpSettings.model_validate({**settings, "url": url}))
    assert not station.capabilities.switches
    for command in (station.start, station.stop, station.hold, station.unlock):
        with pytest.raises(StationUnsupportedError, match="no command"):
            await command()
    await station.close()
