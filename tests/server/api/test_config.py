"""The configuration over the API."""

from __future__ import annotations

from pathlib import Path

import httpx
from pydantic import SecretStr

from drivers.station.settings import OpenevseSettings
from server.config.settings import Settings
from server.config.station import StationSettings
from tests.support.api import on_api, problem
from tests.support.garage import Scene, on_scene

Client = httpx.AsyncClient
HIDDEN = "correct-horse-battery"


async def patch(client: Client, body: object, etag: str = "*") -> httpx.Response:
    return await client.patch("config", json=body, headers={"If-Match": etag})


def test_everything_is_shown_but_secrets() -> None:
    station = StationSettings(
        openevse=OpenevseSettings(url="http://10.0.0.9", password=SecretStr(HIDDEN))
    )

    async def scenario(_: Scene, client: Client) -> None:
        answer = await client.get("config")
        assert HIDDEN not in answer.text
        shown = answer.json()
        assert shown["settings"]["station"]["openevse"]["password"] == "**********"  # noqa: S105
        assert set(shown["settings"]) == set(Settings.model_fields)
        assert set(shown["changeable"]) < set(shown["settings"])

    on_api(scenario, settings=Settings(station=station))


def test_a_change_needs_the_newest_version_and_takes_effect() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        first = (await client.get("config")).headers["etag"]
        body = {"webhooks": {"max_webhooks": 3, "timeout_s": 5}}
        problem(await client.patch("config", json=body), 428, "precondition_required")
        changed = await patch(client, body, first)
        assert changed.status_code == 200, changed.text
        assert changed.json()["settings"]["webhooks"]["max_webhooks"] == 3
        assert changed.headers["etag"] not in {first, ""}
        problem(await patch(client, body, first), 412, "precondition_failed")
        assert scene.services.running_settings.current.webhooks.max_webhooks == 3
        hook = {"url": "https://93.184.216.34/", "events": ["job.ended"], "enabled": False}
        statuses = [(await client.post("webhooks", json=hook)).status_code for _ in range(4)]
        assert statuses == [201, 201, 201, 409]

        back = await patch(client, {"webhooks": {"max_webhooks": None}})
        assert back.json()["settings"]["webhooks"]["max_webhooks"] == 20
        assert back.json()["settings"]["webhooks"]["timeout_s"] == 5

    on_api(scenario)


def test_what_cannot_be_changes_nothing() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        etag = (await client.get("config")).headers["etag"]
        for section in ("insertion", "geometry", "robot", "storage", "nonsense", "station"):
            problem(await patch(client, {section: {"x": 1}}), 409, "setting_fixed")
        opening = {"webhooks": {"timeout_s": 5, "allowed_networks": ["127.0.0.0/8"]}}
        problem(await patch(client, opening), 409, "setting_fixed")
        for wrong in (
            {"webhooks": {"max_webhooks": 0}},
            {"webhooks": {"max_webhoks": 5}},
            {"webhooks": {"timeout_s": "a while"}},
            {"logging": {"level": "chatty"}},
            {"logging": {"level": "debug"}, "charge_point": {"attempts": "often"}},
        ):
            problem(await patch(client, wrong), 422, "settings_invalid")
        nonsenses: list[object] = [[], "x", {"webhooks": 5}, {"webhooks": [1]}]
        for nonsense in nonsenses:
            problem(await patch(client, nonsense), 422, "invalid_request")
        assert (await client.get("config")).headers["etag"] == etag

    on_api(scenario)


def test_changes_survive_a_restart_but_not_their_own_nonsense(tmp_path: Path) -> None:
    async def first(scene: Scene) -> None:
        await scene.services.running_settings.change({"charge_point": {"attempts": 5}})

    async def second(scene: Scene) -> None:
        running = scene.services.running_settings
        assert running.current.charge_point.attempts == 5
        await running._store.save({"charge_point": {"attempts": "not a number"}})

    async def third(scene: Scene) -> None:
        assert scene.services.running_settings.current.charge_point.attempts == 2

    for scenario in (first, second, third):
        on_scene(scenario, folder=tmp_path, parked=False)
