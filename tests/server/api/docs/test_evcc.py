"""The documented evcc configuration, field by field, as evcc would use it."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlsplit

import httpx
import pytest
import yaml  # type: ignore[import-untyped]  # only read here; its stubs are a package of their own

import server.api
from server.access import Scope
from server.jobs.model import JobPhase
from tests.support.api import on_api
from tests.support.garage import Scene

DOCS = Path(server.api.__file__).parent / "docs"
EVCC: dict[str, Any] = yaml.safe_load((DOCS / "evcc.yaml").read_text())
(CHARGER,) = EVCC["chargers"]
HERE = "http://plugpilot"
STATES = {"A", "B", "C", "D", "E", "F"}

STATION_READ_EVERY_S = 2.0
"""At most, while it charges."""

REQUIRED = {"status", "enabled", "enable", "maxcurrent"}
OPTIONAL = {"power", "energy", "currents"}
SOURCE_FIELDS = {"source", "uri", "method", "auth", "headers", "body", "jq", "timeout"}
"""What evcc knows of a custom charger and of its http source."""


def picked(document: Any, expression: str) -> Any:  # noqa: ANN401 - any JSON
    """The part of jq that the example needs: names and places in lists."""
    assert re.fullmatch(r"(\.\w+|\[\d+\])+", expression), expression
    for name, place in re.findall(r"\.(\w+)|\[(\d+)\]", expression):
        document = document[name] if name else document[int(place)]
    return document


def sources() -> Iterator[tuple[str, dict[str, Any]]]:
    for name in sorted(REQUIRED | OPTIONAL):
        value = CHARGER[name]
        yield from ((name, source) for source in (value if isinstance(value, list) else [value]))


async def ask(client: httpx.AsyncClient, source: dict[str, Any], **values: object) -> Any:  # noqa: ANN401 - any JSON
    """One request as evcc's http source makes it. The client adds a key that steers charging."""
    body: str = source.get("body", "")
    for name, value in values.items():
        assert f"${{{name}}}" in body
        body = body.replace(f"${{{name}}}", json.dumps(value))
    answer = await client.request(
        source.get("method", "GET"),
        HERE + urlsplit(source["uri"]).path,
        content=body,
        headers=source.get("headers", {}),
    )
    assert answer.status_code == 200, answer.text
    return picked(answer.json(), source["jq"]) if "jq" in source else answer.json()


def test_evcc_knows_every_word_of_it() -> None:
    assert CHARGER["type"] == "custom"
    assert set(CHARGER) == {"name", "type"} | REQUIRED | OPTIONAL
    for name, source in sources():
        assert set(source) <= SOURCE_FIELDS, name
        assert source["source"] == "http"
        assert source["auth"] == {"type": "bearer", "token": "YOUR KEY"}
        assert ("jq" in source) == (source.get("method", "GET") == "GET"), name
    assert len(CHARGER["currents"]) == 3, "evcc wants all phases or none"
    (loadpoint,) = EVCC["loadpoints"]
    assert loadpoint["charger"] == CHARGER["name"]


def test_every_reading_has_the_type_that_evcc_expects() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        assert await ask(client, CHARGER["status"]) in STATES
        assert isinstance(await ask(client, CHARGER["enabled"]), bool)
        for name in ("power", "energy"):
            assert isinstance(await ask(client, CHARGER[name]), float)
        for source in CHARGER["currents"]:
            assert isinstance(await ask(client, source), float)

    on_api(scenario, parked=True, scopes=[Scope.CHARGE_POINT])


class Metered(NamedTuple):
    """A reading of the meter, and between which moments of the virtual clock it was taken [s]."""

    asked_s: float
    energy_kwh: float
    answered_s: float


async def metered(client: httpx.AsyncClient) -> Metered:
    clock = asyncio.get_running_loop().time
    asked_s = clock()
    energy_kwh = await ask(client, CHARGER["energy"])
    return Metered(asked_s, energy_kwh, clock())


@pytest.mark.parametrize("amperes", [6, 16, 13.8])
def test_evcc_charges_in_mode_now_and_stops_in_mode_off(amperes: float) -> None:
    """What evcc does at each interval: read, set the current, enable, disable."""

    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        assert await ask(client, CHARGER["status"]) == "B", "or evcc would never enable it"
        assert await ask(client, CHARGER["enabled"]) is False
        await ask(client, CHARGER["maxcurrent"], maxcurrent=amperes)
        await ask(client, CHARGER["enable"], enable=True)
        assert await ask(client, CHARGER["enabled"]) is True, "else it is out of sync"
        await scene.until_phase(JobPhase.CHARGING)
        assert await ask(client, CHARGER["enabled"]) is True
        await scene.later(8.0)
        assert await ask(client, CHARGER["status"]) == "C"
        power_w = await ask(client, CHARGER["power"])
        currents_a = [await ask(client, source) for source in CHARGER["currents"]]
        assert currents_a[0] == pytest.approx(amperes, rel=0.02)
        assert power_w == pytest.approx(230 * sum(currents_a), rel=0.02)
        before = await metered(client)
        await scene.later(60.0)
        after = await metered(client)
        shortest_s = after.asked_s - before.answered_s - STATION_READ_EVERY_S
        longest_s = after.answered_s - before.asked_s + STATION_READ_EVERY_S
        charged_w_s = (after.energy_kwh - before.energy_kwh) * 3.6e6
        assert 0.99 * power_w * shortest_s < charged_w_s < 1.01 * power_w * longest_s

        await ask(client, CHARGER["enable"], enable=False)
        await scene.later(5.0)
        assert await ask(client, CHARGER["status"]) == "B"
        assert await ask(client, CHARGER["enabled"]) is False
        assert await ask(client, CHARGER["power"]) == 0.0

    on_api(scenario, parked=True, scopes=[Scope.CHARGE_POINT])
