"""The configuration over the API."""

from __future__ import annotations

from pathlib import Path

import httpx
from pydantic import SecretStr

from drivers.station.settings import OpenevseSettings
from server.config.settings import Settings
from server.config.station import StationSettings
from server.storage.settings import VERSIONS_KEPT
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


def test_a_rehearsal_names_the_field_and_shows_the_difference() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        etag = (await client.get("config")).headers["etag"]
        wrong = {"webhooks": {"timeout_s": -1, "max_log": 5}, "logging": {"level": "chatty"}}
        found = (await client.post("config/check", json=wrong)).json()
        assert [each["key"] for each in found["troubles"]] == [
            "webhooks.timeout_s",
            "logging.level",
        ]
        assert found["differences"] == []
        right = {"webhooks": {"timeout_s": 5, "max_log": 200}}
        found = (await client.post("config/check", json=right)).json()
        assert found == {
            "troubles": [],
            "differences": [{"key": "webhooks.timeout_s", "before": 10.0, "after": 5.0}],
        }
        fixed = (await client.post("config/check", json={"robot": {"port": "x"}})).json()
        assert "robot" in fixed["troubles"][0]["sentence"]
        assert (await client.get("config")).headers["etag"] == etag

    on_api(scenario)


def test_one_can_go_back_to_every_version_and_to_the_start() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        for timeout_s in (5, 6, 7):
            answer = await patch(client, {"webhooks": {"timeout_s": timeout_s}})
            assert answer.status_code == 200
        versions = (await client.get("config/versions")).json()["versions"]
        assert [each["changes"].get("webhooks") for each in versions] == [
            {"timeout_s": 7},
            {"timeout_s": 6},
            {"timeout_s": 5},
            None,
        ]
        assert all(each["by"] for each in versions[:-1])
        back = f"config/versions/{versions[2]['number']}/restore"
        problem(await client.post(back), 428, "precondition_required")
        etag = answer.headers["etag"]
        answer = await client.post(back, headers={"If-Match": etag})
        assert answer.json()["settings"]["webhooks"]["timeout_s"] == 5
        assert scene.services.running_settings.current.webhooks.timeout_s == 5
        problem(await client.post(back, headers={"If-Match": etag}), 412, "precondition_failed")
        start = await client.post("config/versions/0/restore", headers={"If-Match": "*"})
        assert start.json()["settings"]["webhooks"]["timeout_s"] == 10
        missing = await client.post("config/versions/999/restore", headers={"If-Match": "*"})
        problem(missing, 404, "no_such_version")
        assert len((await client.get("config/versions")).json()["versions"]) == 6

    on_api(scenario)


def test_only_so_many_versions_are_kept() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        for number in range(VERSIONS_KEPT + 3):
            await scene.services.running_settings.change({"webhooks": {"max_log": number + 1}})
        versions = (await client.get("config/versions")).json()["versions"]
        assert len(versions) == VERSIONS_KEPT + 1
        assert versions[0]["changes"] == {"webhooks": {"max_log": VERSIONS_KEPT + 3}}

    on_api(scenario)


def test_every_setting_is_a_field_and_says_whether_it_needs_a_restart() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        fields = {
            each["key"]: each for each in (await client.get("config/fields")).json()["fields"]
        }
        assert {key.partition(".")[0] for key in fields} == set(Settings.model_fields)
        assert fields["logging.level"]["choices"] == ["debug", "info", "warning", "error"]
        assert fields["webhooks.timeout_s"]["most"] == 60
        assert fields["charge_point.vehicle_id"]["optional"]
        assert fields["charge_point.attempts"]["changeable"]
        assert not fields["webhooks.allowed_networks"]["changeable"]
        assert not fields["robot.port"]["changeable"]

    on_api(scenario)
