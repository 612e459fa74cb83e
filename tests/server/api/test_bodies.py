"""Bodies that are huge, endless, slow or nonsense; and lists that come in pages."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import httpx
import pytest

from server.api.gate.body import MAX_BYTES, PATIENCE_S
from server.jobs.model import JobType
from tests.support.api import on_api, problem
from tests.support.garage import Scene

Client = httpx.AsyncClient
JSON = {"Content-Type": "application/json"}


def test_a_huge_body_is_refused_before_it_is_read() -> None:
    read = 0

    async def endless() -> AsyncIterator[bytes]:
        nonlocal read
        while True:
            read += 65536
            yield b" " * 65536

    async def scenario(_: Scene, client: Client) -> None:
        said = {**JSON, "Content-Length": str(10**12)}
        problem(await client.post("jobs", content=b"{}", headers=said), 413, "body_too_large")
        problem(
            await client.post("jobs", content=b" " * (MAX_BYTES + 1), headers=JSON),
            413,
            "body_too_large",
        )
        problem(await client.post("jobs", content=endless(), headers=JSON), 413, "body_too_large")
        assert read <= MAX_BYTES + 2 * 65536
        stop = await client.post("robot/stop", content=b"x" * (MAX_BYTES + 1))
        assert stop.status_code == 200, "nothing can be wrong with a stop"

    on_api(scenario)


def test_a_body_that_does_not_come_is_given_up() -> None:
    async def trickle() -> AsyncIterator[bytes]:
        while True:
            await asyncio.sleep(1)
            yield b" "

    async def scenario(scene: Scene, client: Client) -> None:
        began_s = scene.now_s
        problem(await client.post("jobs", content=trickle(), headers=JSON), 408, "body_too_slow")
        assert PATIENCE_S - 1 < scene.now_s - began_s < 1.5 * PATIENCE_S

    on_api(scenario)


@pytest.mark.parametrize(
    ("body", "status", "code"),
    [
        (b"", 422, "invalid_request"),
        (b"{", 400, "malformed_json"),
        (b"[" * 60_000, 400, "malformed_json"),
        (b"\xff\xfe", 400, "malformed_json"),
        (b'{"type": "charge", "type": 5}', 422, "invalid_request"),
        (b'{"type": ["charge"]}', 422, "invalid_request"),
        (b'{"type": null}', 422, "invalid_request"),
        (b'{"type": "charge", "target_energy_wh": 1e999}', 422, "invalid_request"),
        (b'{"type": "charge", "target_energy_wh": NaN}', 422, "invalid_request"),
        (b'{"type": "charge", "vehicle_id": "../../etc"}', 422, "invalid_request"),
        (b'"charge"', 422, "invalid_request"),
    ],
)
def test_nonsense_is_answered_in_words(body: bytes, status: int, code: str) -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        problem(await client.post("jobs", content=body, headers=JSON), status, code)
        assert scene.services.runner.newest is None

    on_api(scenario)


def test_vehicles_and_journals_come_in_pages() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        for name in ("Ada", "Bob", "Cid"):
            put = await client.put(f"vehicles/{name.lower()}", json={"name": name})
            assert put.status_code == 201, put.text
        first = (await client.get("vehicles", params={"limit": 2})).json()
        assert [v["id"] for v in first["items"]] == ["ada", "bob"]
        params = {"limit": 2, "cursor": first["next_cursor"]}
        second = (await client.get("vehicles", params=params)).json()
        assert [v["id"] for v in second["items"]] == ["cid", "demo"]
        assert second["next_cursor"] is None
        problem(await client.get("vehicles?cursor=nobody"), 400, "invalid_cursor")

        body = {"type": "plug_in", "vehicle_id": "demo"}
        job = (await client.post("jobs", json=body)).json()
        await scene.services.runner.wait()
        whole = (await client.get(f"jobs/{job['id']}/events")).json()["items"]
        assert scene.services.runner.newest is not None
        assert scene.services.runner.newest.type is JobType.PLUG_IN
        pieces: list[object] = []
        cursor: str | None = "0"
        while cursor is not None:
            params = {"cursor": cursor, "limit": 3}
            page = (await client.get(f"jobs/{job['id']}/events", params=params)).json()
            pieces += page["items"]
            cursor = page["next_cursor"]
        assert pieces == whole
        problem(await client.get(f"jobs/{job['id']}/events?cursor=-1"), 400, "invalid_cursor")

    on_api(scenario, parked=True)


def test_two_who_change_the_same_vehicle_do_not_overwrite_each_other() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        etag = (await client.get("vehicles/demo")).headers["etag"]
        problem(await client.put("vehicles/demo", json={"name": "x"}), 428, "precondition_required")
        answers = await asyncio.gather(
            *(
                client.put("vehicles/demo", json={"name": name}, headers={"If-Match": etag})
                for name in ("mine", "yours")
            )
        )
        assert sorted(answer.status_code for answer in answers) == [200, 412]
        problem(
            await client.delete("vehicles/demo", headers={"If-Match": etag}),
            412,
            "precondition_failed",
        )
        assert (await client.delete("vehicles/demo")).status_code == 204

    on_api(scenario)
