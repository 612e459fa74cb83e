"""Jobs over REST."""

from __future__ import annotations

import asyncio

import httpx

from server.jobs.model import JobPhase, JobState
from server.schema.jobs import Job, JobEvents, JobPage
from server.schema.vehicles import VehicleSettings
from tests.support.api import on_api, problem
from tests.support.garage import Scene

PLUG_IN = {"type": "plug_in"}
IS_JSON = {"Content-Type": "application/json"}


async def _cancelled(scene: Scene, client: httpx.AsyncClient, job_id: str) -> Job:
    accepted = await client.post(f"jobs/{job_id}/cancel")
    assert accepted.status_code == 202
    await scene.services.runner.wait()
    return Job.model_validate_json((await client.get(f"jobs/{job_id}")).content)


def test_a_job_from_its_acceptance_to_its_journal() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        response = await client.post("jobs", json=PLUG_IN)
        assert response.status_code == 202
        job = Job.model_validate_json(response.content)
        assert response.headers["location"] == f"/api/v1/jobs/{job.id}"
        assert job.state is JobState.QUEUED
        assert job.vehicle_id == "demo"
        problem(await client.post(f"jobs/{job.id}/finish"), 409, "not_charging")
        await scene.later(0.1)  # it begins
        ended = await _cancelled(scene, client, job.id)
        assert ended.state is JobState.CANCELLED
        again = Job.model_validate_json(
            (await client.get(f"http://plugpilot{response.headers['location']}")).content
        )
        assert again == ended
        problem(await client.post(f"jobs/{job.id}/cancel"), 409, "job_ended")
        problem(await client.post(f"jobs/{job.id}/finish"), 409, "job_ended")
        events = JobEvents.model_validate_json((await client.get(f"jobs/{job.id}/events")).content)
        assert events.items[0].kind == "phase_started"
        assert events.items[-1].kind == "cancelled"
        assert [event.sequence for event in events.items] == list(range(1, len(events.items) + 1))

    on_api(scenario)


def test_finishing_a_charge() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        job = (await client.post("jobs", json={"type": "charge"})).json()
        await scene.until_phase(JobPhase.CHARGING)
        assert (await client.post(f"jobs/{job['id']}/finish")).status_code == 202
        await scene.services.runner.wait()
        assert (await client.get(f"jobs/{job['id']}")).json()["state"] == "succeeded"

    on_api(scenario, parked=True)


def test_the_same_key_with_the_same_body_is_the_same_job() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        key = {"Idempotency-Key": "4711"}
        answers = await asyncio.gather(
            *(client.post("jobs", json=PLUG_IN, headers=key) for _ in range(5))
        )
        assert {answer.status_code for answer in answers} == {202}
        [job_id] = {answer.json()["id"] for answer in answers}
        charge = {"type": "charge"}
        refused = problem(
            await client.post("jobs", json=charge, headers=key), 422, "idempotency_key_reused"
        )
        assert refused["context"]["job_id"] == job_id
        other = {"Idempotency-Key": "4712"}
        second = await client.post("jobs", json=PLUG_IN, headers=other)
        assert second.status_code == 202
        assert second.json()["state"] == "queued"
        again = await client.post("jobs", json=PLUG_IN, headers=other)
        assert again.json()["id"] == second.json()["id"]
        problem(await client.post("jobs", json=PLUG_IN), 409, "job_queue_full")
        dropped = await client.post(f"jobs/{second.json()['id']}/cancel")
        assert dropped.json()["state"] == "cancelled"
        await _cancelled(scene, client, job_id)
        late = await client.post("jobs", json=PLUG_IN, headers=key)
        assert late.json()["state"] == "cancelled"  # the same job, as it is by now
        fresh = await client.post("jobs", json=PLUG_IN, headers={"Idempotency-Key": "4713"})
        assert fresh.status_code == 202
        assert fresh.json()["id"] != job_id
        await _cancelled(scene, client, fresh.json()["id"])

    on_api(scenario)


def test_keys_that_cannot_be() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for key in ("", "k" * 256):
            answer = await client.post("jobs", json=PLUG_IN, headers={"Idempotency-Key": key})
            problem(answer, 422, "invalid_request")

    on_api(scenario)


def test_which_vehicle() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        unknown = {**PLUG_IN, "vehicle_id": "nobody"}
        problem(await client.post("jobs", json=unknown), 404, "unknown_vehicle")
        await scene.services.vehicles.put("zoe", VehicleSettings(name="Zoe"))
        refused = problem(await client.post("jobs", json=PLUG_IN), 422, "vehicle_required")
        assert "demo" in refused["detail"]
        assert "zoe" in refused["detail"]
        for vehicle_id in ("demo", "zoe"):
            await scene.services.vehicles.delete(vehicle_id)
        problem(await client.post("jobs", json=PLUG_IN), 404, "unknown_vehicle")
        assert (await client.get("jobs")).json() == {"items": [], "next_cursor": None}

    on_api(scenario)


NO_JSON: list[str | bytes] = [
    "{",
    "'plug_in'",
    '{"type": "plug_in"}}',
    '{"type": ' + "9" * 5000 + "}",  # more digits than Python reads
    b"\xff\xfe{}",
    "[" * 60_000,
]


def test_what_is_not_json() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for body in NO_JSON:
            answer = await client.post("jobs", content=body, headers=IS_JSON)
            problem(answer, 400, "malformed_json")
        problem(await client.post("jobs", content="", headers=IS_JSON), 422, "invalid_request")

    on_api(scenario)


UNFIT = [
    ("{}", "type"),
    ("[]", "body"),
    ("null", "body"),
    ('"plug_in"', "body"),
    ('{"type": "dance"}', "type"),
    ('{"type": null}', "type"),
    ('{"type": 1}', "type"),
    ('{"type": "charge", "speed": 3}', "speed"),
    ('{"type": "charge", "target_energy_wh": NaN}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": Infinity}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": 1e999}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": 1e300}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": 0}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": -1}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": "a lot"}', "target_energy_wh"),
    ('{"type": "charge", "target_energy_wh": [5]}', "target_energy_wh"),
    ('{"type": "plug_in", "target_energy_wh": 500}', "body"),
    ('{"type": "charge", "vehicle_id": "../etc/passwd"}', "vehicle_id"),
    ('{"type": "charge", "vehicle_id": "' + "a" * 65 + '"}', "vehicle_id"),
    ('{"type": "charge", "vehicle_id": ""}', "vehicle_id"),
]


def test_what_does_not_fit_is_named() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for body, field in UNFIT:
            answer = await client.post("jobs", content=body, headers=IS_JSON)
            document = problem(answer, 422, "invalid_request")
            assert [fault["field"] for fault in document["context"]["fields"]] == [field], body
        assert (await client.get("jobs")).json()["items"] == []

    on_api(scenario)


def test_pages_of_the_list() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        made = []
        for _ in range(5):
            job = (await client.post("jobs", json=PLUG_IN)).json()
            await _cancelled(scene, client, job["id"])
            made.append(job["id"])
        found: list[str] = []
        cursor: dict[str, str] = {}
        pages = 0
        while True:
            answer = await client.get("jobs", params={"limit": 2, **cursor})
            page = JobPage.model_validate_json(answer.content)
            assert len(page.items) <= 2
            found += [job.id for job in page.items]
            pages += 1
            if page.next_cursor is None:
                break
            # any spelling of the id will do
            cursor = {"cursor": page.next_cursor.upper()}
        assert found == made[::-1]
        assert pages == 3

    on_api(scenario)


QUERIES = [
    ({"cursor": "yesterday"}, 400, "invalid_cursor"),
    ({"cursor": ""}, 400, "invalid_cursor"),
    ({"cursor": "1' OR '1'='1"}, 400, "invalid_cursor"),
    ({"cursor": "0" * 65}, 422, "invalid_request"),
    ({"limit": "0"}, 422, "invalid_request"),
    ({"limit": "101"}, 422, "invalid_request"),
    ({"limit": "many"}, 422, "invalid_request"),
]


def test_queries_that_cannot_be() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for query, status, code in QUERIES:
            problem(await client.get("jobs", params=query), status, code)

    on_api(scenario)


def test_jobs_that_never_were() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for job_id in ("0", "00000000-0000-0000-0000-000000000000", "%00", "a b", "ä"):
            problem(await client.get(f"jobs/{job_id}"), 404, "job_not_found")
            problem(await client.get(f"jobs/{job_id}/events"), 404, "job_not_found")
            problem(await client.post(f"jobs/{job_id}/cancel"), 404, "job_not_found")
            problem(await client.post(f"jobs/{job_id}/finish"), 404, "job_not_found")
        problem(await client.get("jobs/" + "0" * 65), 422, "invalid_request")

    on_api(scenario)
