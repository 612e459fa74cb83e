"""Notifications of one's own browser over the API."""

from __future__ import annotations

import httpx

from server.access import Scope
from tests.server.push.browser import PushBrowser
from tests.support.api import on_api, problem
from tests.support.garage import Scene

Client = httpx.AsyncClient
WANTED = PushBrowser().subscription("https://8.8.8.8/send/1", "de").model_dump(mode="json")


def test_a_browser_is_notified_until_it_is_not() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        before = (await client.get("push")).json()
        assert before["subscribed"] is False
        assert len(before["public_key"]) == 87
        assert (await client.put("push", json=WANTED)).status_code == 204
        assert (await client.get("push")).json() == {**before, "subscribed": True}
        assert (await client.delete("push")).status_code == 204
        assert (await client.get("push")).json() == before

    on_api(scenario)


def test_an_inner_address_is_refused() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        inside = {**WANTED, "endpoint": "https://192.168.1.1/"}
        problem(await client.put("push", json=inside), 422, "push_refused")
        problem(
            await client.put("push", json={**WANTED, "language": "tlh"}), 422, "invalid_request"
        )

    on_api(scenario)


def test_a_program_has_no_browser() -> None:
    async def scenario(_: Scene, client: Client) -> None:
        problem(await client.get("push"), 403, "forbidden")

    on_api(scenario, scopes=[Scope.ADMIN])
