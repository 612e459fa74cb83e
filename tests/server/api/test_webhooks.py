"""Webhooks over the API."""

from __future__ import annotations

import httpx

from server.config.settings import Settings
from tests.server.webhooks.receiver import OPEN
from tests.support.api import on_api, problem
from tests.support.garage import Scene

Client = httpx.AsyncClient
HOOK = {"url": "http://127.0.0.1:1/hook", "events": ["job.ended", "job.ended"]}
HOME = Settings(webhooks=OPEN)


def test_made_read_changed_and_deleted() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        made = await client.post("webhooks", json=HOOK)
        assert made.status_code == 201, made.text
        assert made.json()["secret"].startswith("whsec_")
        assert made.json()["events"] == ["job.ended"]
        where = made.headers["location"].removeprefix("/api/v1/")
        read = await client.get(where)
        assert "secret" not in read.json()
        assert read.headers["etag"] == made.headers["etag"]

        changed = {**HOOK, "description": "Phone", "enabled": False}
        problem(await client.put(where, json=changed), 428, "precondition_required")
        wrong = {"If-Match": '"0123456789abcdef"'}
        problem(await client.put(where, json=changed, headers=wrong), 412, "precondition_failed")
        right = {"If-Match": read.headers["etag"]}
        after = await client.put(where, json=changed, headers=right)
        assert after.status_code == 200, after.text
        assert after.json()["description"] == "Phone"
        problem(await client.put(where, json=changed, headers=right), 412, "precondition_failed")
        problem(await client.delete(where, headers=right), 412, "precondition_failed")
        rotated = await client.post(f"{where}/rotate-secret")
        assert rotated.json()["secret"] != made.json()["secret"]
        assert (await client.delete(where)).status_code == 204
        problem(await client.get(where), 404, "webhook_not_found")

    on_api(scenario, settings=HOME)


def test_a_ping_shows_in_the_log_page_by_page() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        made = (await client.post("webhooks", json={**HOOK, "enabled": False})).json()
        where = f"webhooks/{made['id']}"
        pings = [(await client.post(f"{where}/ping")).json()["id"] for _ in range(5)]
        seen: list[str] = []
        cursor: dict[str, str] = {}
        while True:
            page = (await client.get(f"{where}/deliveries", params={"limit": 2, **cursor})).json()
            assert all(item["state"] == "dropped" for item in page["items"])
            seen += [item["id"] for item in page["items"]]
            if page["next_cursor"] is None:
                break
            cursor = {"cursor": page["next_cursor"]}
        assert seen == pings[::-1]
        params = {"cursor": "nonsense"}
        problem(await client.get(f"{where}/deliveries", params=params), 400, "invalid_cursor")
        assert scene.services.supervisor.holder is None

    on_api(scenario, settings=HOME)


def test_targets_inside_are_refused_with_what_to_do() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        for url in (
            "http://127.0.0.1:8000/api/v1/robot/stop",
            "https://[::1]/",
            "https://10.1.1.1",
        ):
            answer = await client.post("webhooks", json={**HOOK, "url": url})
            document = problem(answer, 422, "target_forbidden")
            assert "allowed_networks" in document["detail"] + document["remedy"]
        wrongs: list[dict[str, object]] = [
            {"url": "ftp://example.com"},
            {"events": []},
            {"events": ["ping"]},
            {"url": 5},
            {"description": "x" * 201},
            {"secret": "whsec_mine"},
        ]
        for wrong in wrongs:
            problem(await client.post("webhooks", json={**HOOK, **wrong}), 422, "invalid_request")

    on_api(scenario)
