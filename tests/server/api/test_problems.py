"""Whatever goes wrong, the answer is a problem document."""

from __future__ import annotations

import httpx
import pytest

from server.storage.errors import StorageError
from tests.support.api import on_api, problem
from tests.support.garage import Scene

NOWHERE = ["nothing", "jobs/1/2/3", "../../api", "http://plugpilot/api/v2/jobs"]
OTHER_METHOD = [
    ("GET", "robot/stop"),
    ("DELETE", "jobs"),
    ("PATCH", "vehicles/demo"),
    ("POST", "health"),
]


def test_there_is_nothing_there() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for path in NOWHERE:
            problem(await client.get(path), 404, "not_found")

    on_api(scenario)


def test_this_method_is_not_for_this_address() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for method, path in OTHER_METHOD:
            answer = await client.request(method, path)
            problem(answer, 405, "method_not_allowed")
            assert answer.headers["allow"]

    on_api(scenario)


def test_a_surprise_tells_nothing_of_the_inside(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def explode() -> None:
            raise ZeroDivisionError("the secret is 42")

        monkeypatch.setattr(scene.services.vehicles, "all", explode)
        document = problem(await client.get("vehicles"), 500, "internal")
        assert "ZeroDivision" not in str(document)
        assert "secret" not in str(document)
        assert "the secret is 42" in caplog.text

    on_api(scenario)


def test_a_disk_that_fails_is_told() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def full(*_: object, **__: object) -> None:
            raise StorageError("The disk is full.")

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(scene.services.jobs, "add", full)
            problem(await client.post("jobs", json={"type": "plug_in"}), 503, "storage")
            patch.setattr(scene.services.jobs, "page", full)
            problem(await client.get("jobs"), 503, "storage")
        assert scene.services.supervisor.holder is None
        assert (await client.post("jobs", json={"type": "plug_in"})).status_code == 202

    on_api(scenario)
