"""The documented Home Assistant configuration: every request is made, every template found."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import httpx
import yaml  # type: ignore[import-untyped]  # only read here; its stubs are a package of their own

import server.api
from server.access import Scope
from server.control.model import PlugState
from tests.support.api import on_api
from tests.support.garage import Scene

FILE = Path(server.api.__file__).parent / "docs" / "home_assistant.yaml"
CONFIGURATION: dict[str, Any] = yaml.safe_load(FILE.read_text())
HERE = "http://plugpilot"
KEY = {"Authorization": "Bearer YOUR KEY"}
SCOPES = [Scope.OPERATE, Scope.CHARGE_POINT]
"""Of the key, which the client adds to its requests."""
COMMANDS: dict[str, dict[str, Any]] = CONFIGURATION["rest_command"]


def value_of(template: str, document: dict[str, Any]) -> Any:  # noqa: ANN401 - any JSON
    """A template that only names a field."""
    found = re.fullmatch(r"\{\{ value_json\.(\w+) \}\}", template)
    assert found, template
    return document[found.group(1)]


def plug(scene: Scene) -> PlugState:
    return scene.services.supervisor.plug.state


async def command(client: httpx.AsyncClient, name: str, **values: object) -> httpx.Response:
    said = COMMANDS[name]
    payload: str = said.get("payload", "")
    for key, value in values.items():
        assert f"{{{{ {key} }}}}" in payload
        payload = payload.replace(f"{{{{ {key} }}}}", json.dumps(value))
    assert "{{" not in payload
    assert said["headers"] == KEY
    headers = {"Content-Type": said.get("content_type", "text/plain")}
    path = HERE + urlsplit(said["url"]).path
    answer = await client.request(said["method"].upper(), path, content=payload, headers=headers)
    assert answer.is_success, f"{name}: {answer.text}"
    return answer


def test_every_sensor_finds_its_value() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        found = {}
        for resource in CONFIGURATION["rest"]:
            assert resource["headers"] == KEY
            answer = await client.get(HERE + urlsplit(resource["resource"]).path)
            assert answer.status_code == 200
            for sensor in [*resource.get("sensor", []), *resource.get("binary_sensor", [])]:
                found[sensor["unique_id"]] = value_of(sensor["value_template"], answer.json())
        assert found == {
            "plugpilot_robot_state": "parked",
            "plugpilot_power": 0.0,
            "plugpilot_energy": 0.0,
            "plugpilot_enabled": False,
            "plugpilot_plug": "parked",
        }

    on_api(scenario, parked=True, scopes=SCOPES)


def test_every_command_does_what_it_says() -> None:
    used: set[str] = set()

    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def do(name: str, **values: object) -> httpx.Response:
            used.add(name)
            return await command(client, name, **values)

        await do("plugpilot_max_current", current=10)
        await do("plugpilot_plug_in")
        await scene.services.runner.wait()
        assert plug(scene) is PlugState.INSERTED
        await do("plugpilot_enable", enabled=True)
        await scene.later(5.0)
        assert (await scene.station()).currents_a[0] > 9.0
        await do("plugpilot_enable", enabled=False)
        await scene.later(3.0)
        assert not (await scene.station()).carries_load
        await do("plugpilot_unplug")
        await scene.services.runner.wait()
        assert plug(scene) is PlugState.PARKED
        assert (await client.get("charge-point")).json()["resting"] == "unplugged"
        resumed = await do("plugpilot_car_has_come")
        assert resumed.json()["resting"] is None
        assert (await do("plugpilot_stop")).json()["mode"] == "stopped"

    on_api(scenario, parked=True, scopes=SCOPES)
    assert used == set(COMMANDS)
