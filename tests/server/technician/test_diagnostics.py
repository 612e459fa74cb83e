"""The diagnostics bundle: everything to find a cause, and nothing that opens a door."""

from __future__ import annotations

import io
import json
import logging
import zipfile

import httpx
import pytest

from server.access import Scope
from server.config.settings import Settings
from server.technician.recent_log import KEPT, RecentLog
from server.technician.redaction import Redaction
from tests.support.api import on_api
from tests.support.garage import Scene
from tests.support.pairing import new_device, new_key

PASSWORD = "correct-horse-battery"  # noqa: S105 - what must not be found
SETTINGS = Settings.model_validate(
    {
        "station": {"openevse": {"url": "http://10.0.0.9", "password": PASSWORD}},
        "camera": {
            "link": {
                "stream": {"url": "rtsp://10.0.0.8/live", "user": "admin", "password": "hunter22"}
            }
        },
    }
)
_log = logging.getLogger("plugpilot.test")


async def _bundle(client: httpx.AsyncClient) -> dict[str, str]:
    answer = await client.get("diagnostics.zip")
    assert answer.status_code == 200, answer.text
    assert answer.headers["content-type"] == "application/zip"
    assert ".zip" in answer.headers["content-disposition"]
    with zipfile.ZipFile(io.BytesIO(answer.content)) as bundle:
        assert bundle.testzip() is None
        return {name: bundle.read(name).decode() for name in bundle.namelist()}


def test_no_secret_is_in_it_wherever_it_was_written() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        access = scene.services.access
        secrets = [PASSWORD, "hunter22", await new_device(access)]
        secrets.append(await new_key(access, Scope.ADMIN))
        hook = {"url": "https://93.184.216.34/", "events": ["job.ended"], "enabled": False}
        secrets.append((await client.post("webhooks", json=hook)).json()["secret"])
        secrets.append(await access.pairing.invite_owner(address=""))
        secrets.append(scene.services.vehicles._key.secret.hex())
        for secret in secrets:
            _log.warning("http://robot/#pair=%s", secret)
            _log.warning("Authorization: Bearer %s", secret)
        _log.warning("the station answered 401 to %s", PASSWORD)
        _log.warning("the key was %s, the webhook's %s", secrets[3], secrets[4])
        await scene.services.running_settings.change({"logging": {"level": "debug"}}, by="Anna")
        found = await _bundle(client)
        for secret in secrets:
            for name, text in found.items():
                assert secret not in text, f"{secret!r} in {name}"

    on_api(scenario, settings=SETTINGS)


def test_everything_promised_is_in_it() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        _log.warning("the belt sounds strange")
        await client.post("robot/enable")
        found = await _bundle(client)
        readme = found.pop("README.txt")
        assert all(name in readme for name in found)
        assert "the belt sounds strange" in found["log.txt"]
        assert json.loads(found["live.json"])["live"]["robot"]["driver"] == "Simulator"
        assert json.loads(found["versions.json"])["firmware"] == "simulated"
        settings = json.loads(found["configuration.json"])["settings"]
        assert set(settings) == set(Settings.model_fields)
        assert settings["station"]["openevse"]["password"] != PASSWORD
        assert "Telemetry" in found["protocol.txt"]
        assert "enableRobot" in found["audit.jsonl"]
        assert json.loads(found["jobs.json"]) == []
        assert json.loads(found["link.json"])["link"]["sample_age_s"] < 1

    on_api(scenario, settings=SETTINGS)


def test_only_an_owner_gets_it() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        assert (await client.get("diagnostics.zip")).status_code == 403
        assert (await client.get("versions")).status_code == 200

    on_api(scenario, scopes=[Scope.SERVICE])


@pytest.mark.parametrize(
    ("text", "clean"),
    [
        ("rtsp://me:pw@cam/stream", "rtsp://(hidden)@cam/stream"),
        ("http://r/#pair=abc-DEF_1", "http://r/#pair=(hidden)"),
        ("Bearer abc.def", "Bearer (hidden)"),
        ("cookie: plugpilot=abc; a=b", "cookie: (hidden)"),
        (f"x{PASSWORD}y", "x(hidden)y"),
        ("mail me@home", "mail me@home"),
        ("https://evcc.local/path?x=1", "https://evcc.local/path?x=1"),
    ],
)
def test_what_looks_like_a_secret_is_hidden_and_nothing_else(text: str, clean: str) -> None:
    assert Redaction(SETTINGS).clean(text) == clean


def test_the_kept_log_is_bounded() -> None:
    log = RecentLog()
    for number in range(KEPT + 10):
        log.emit(logging.LogRecord("a", logging.INFO, "f", 1, f"{number} " + "x" * 9999, (), None))
    assert len(log.lines) == KEPT
    assert f" {KEPT + 9} " in log.lines[-1]
    assert len(log.lines[-1]) == 2000
