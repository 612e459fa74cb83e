"""The gate of the real application: names, origins, sizes, times, attempts, headers."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from datetime import timedelta

import httpx
import pytest

from server.access import Role
from server.access.limits import ATTEMPTS, Attempts
from server.api.gate.body import MAX_BYTES
from server.api.gate.caller import COOKIE
from tests.support.api import application, problem
from tests.support.garage import Scene, on_scene
from tests.support.pairing import new_device

ELSEWHERE = "203.0.113.5"
WRONG = {"secret": "wrong-but-long-enough"}

Scenario = Callable[[Scene, httpx.AsyncClient], Awaitable[None]]


def at_the_gate(
    scenario: Scenario, *, address: str = ELSEWHERE, host: str = "robot", role: Role | None = None
) -> None:
    """Run a scenario with a browser at some address, paired or not."""

    async def with_client(scene: Scene) -> None:
        app = application(scene.services)
        cookies = {COOKIE: await new_device(scene.services.access, role)} if role else {}
        transport = httpx.ASGITransport(app, raise_app_exceptions=False, client=(address, 50_000))
        async with httpx.AsyncClient(
            transport=transport, base_url=f"http://{host}/api/v1/", cookies=cookies
        ) as client:
            await scenario(scene, client)

    on_scene(with_client, parked=False)


def test_a_foreign_name_is_refused_before_anything_else() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for path in ("health", "robot", "access/session", "nothing"):
            answer = await client.get(path, headers={"Host": "evil.example"})
            problem(answer, 421, "unknown_host")
        problem(
            await client.post("robot/stop", headers={"Host": "evil.example"}), 421, "unknown_host"
        )

    at_the_gate(scenario, role=Role.OWNER)


def test_a_page_from_elsewhere_can_do_nothing_with_the_owners_browser() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        for headers in (
            {"Origin": "http://evil.example"},
            {"Origin": "null"},
            {"Sec-Fetch-Site": "cross-site"},
            {"Sec-Fetch-Site": "same-site", "Origin": "http://robot:9000"},
        ):
            for path in ("robot/stop", "jobs", "access/keys", "access/pairing"):
                problem(await client.post(path, headers=headers), 403, "wrong_origin")
        assert (await client.post("robot/stop", headers={"Origin": "http://robot"})).is_success
        assert not scene.services.access.register.keys

    at_the_gate(scenario, role=Role.OWNER)


@pytest.mark.parametrize("address", ["127.0.0.1", "::1", "::ffff:127.0.0.1"])
def test_at_the_machine_itself_anybody_may_stop_and_nothing_else(address: str) -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for path in ("robot/stop", "robot/estop"):
            assert (await client.post(path)).status_code == 200
        problem(await client.post("robot/reset"), 401, "not_paired")
        problem(await client.get("robot"), 401, "not_paired")
        # neither through a proxy, nor for a page that rebinds its name
        for headers in (
            {"X-Forwarded-For": "198.51.100.1"},
            {"Forwarded": "for=198.51.100.1"},
            {"Host": "robot.local"},
        ):
            problem(await client.post("robot/stop", headers=headers), 401, "not_paired")

    at_the_gate(scenario, address=address, host="localhost")


def test_from_elsewhere_nobody_stops_without_being_paired() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for host in ("localhost", "127.0.0.1", "robot"):
            problem(await client.post("robot/stop", headers={"Host": host}), 401, "not_paired")

    at_the_gate(scenario, host="localhost")


def test_attempts_to_get_in_are_limited_and_a_stop_is_not() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        scene.services.access.attempts = Attempts(ATTEMPTS, per_s=600)
        for _ in range(ATTEMPTS):
            problem(await client.post("access/pairing", json=WRONG), 403, "invitation")
        began_s = scene.now_s
        answer = await client.post("access/pairing", json=WRONG)
        problem(answer, 429, "too_many_attempts")
        assert int(answer.headers["retry-after"]) >= 1
        assert answer.headers["connection"] == "close"
        assert scene.now_s - began_s > 0.99, "whoever tries too often waits"
        cookie = await new_device(scene.services.access, Role.VIEWER)
        await client.post("robot/stop", headers={"Cookie": f"{COOKIE}={cookie}"})
        began_s = scene.now_s
        for _ in range(50):
            stop = await client.post("robot/stop", headers={"Cookie": f"{COOKIE}={cookie}"})
            assert stop.status_code == 200
        assert scene.now_s - began_s < 45, "fifty that wait a second each would take longer"
        await scene.later(100)
        problem(await client.post("access/pairing", json=WRONG), 403, "invitation")

    at_the_gate(scenario)


def test_every_refusal_of_an_invitation_is_the_same() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        pairing = scene.services.access.pairing
        used = await pairing.invite_owner(address="")
        assert (await client.post("access/pairing", json={"secret": used})).is_success
        client.cookies.clear()
        expired = await pairing.invite_owner(address="", valid=timedelta(seconds=30))
        await scene.later(31)
        withdrawn = await pairing.invite_owner(address="")
        await pairing.invite_owner(address="")  # only the newest is valid
        answers = [
            await client.post("access/pairing", json={"secret": secret})
            for secret in (used, expired, withdrawn, "never-made-at-all", "x" * 200)
        ]
        assert len({answer.content for answer in answers}) == 1
        problem(answers[0], 403, "invitation")

    at_the_gate(scenario)


def test_the_trail_tells_of_an_invitation_once_and_of_a_refused_one_too() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await client.post("access/invitations", json={"name": "Anna", "role": "viewer"})
        (open_one,) = (await client.get("access/invitations")).json()["items"]
        withdrawn = await client.delete(f"access/invitations/{open_one['id']}")
        assert withdrawn.status_code == 204
        assert "content-type" not in withdrawn.headers
        again = await client.delete(f"access/invitations/{open_one['id']}")
        problem(again, 404, "no_such_entry")
        entries = await scene.services.access.audit.page(before=None, limit=3)
        assert [entry.event for entry in entries] == [
            "access",
            "invitation.withdrawn",
            "invitation.created",
        ]
        assert entries[0].detail["status"] == 404

    at_the_gate(scenario, role=Role.OWNER)


def test_a_long_body_is_refused_before_it_is_read() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        declared = await client.post("jobs", content=b" " * (MAX_BYTES + 1))
        problem(declared, 413, "body_too_large")

        async def endless() -> AsyncIterator[bytes]:
            for _ in range(MAX_BYTES // 1024 + 5):
                yield b" " * 1024

        problem(await client.post("jobs", content=endless()), 413, "body_too_large")

    at_the_gate(scenario, role=Role.OWNER)


def test_a_body_that_does_not_come_is_not_waited_for() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def slow() -> AsyncIterator[bytes]:
            yield b"{"
            await asyncio.sleep(60)
            yield b"}"

        await client.post("robot/stop")  # now the board is there and stopped
        began_s = scene.now_s
        problem(await client.post("jobs", content=slow()), 408, "body_too_slow")
        assert scene.now_s - began_s == pytest.approx(10, abs=0.5)
        began_s = scene.now_s
        assert (await client.post("robot/stop", content=slow())).status_code == 200
        assert scene.now_s - began_s < 8, "a stop needs no body"

    at_the_gate(scenario, role=Role.OWNER)


@pytest.mark.parametrize(
    "name", ["", " \u00a0", "An\nna", "Anna\x1b[2J", "\u202eannA", "A\u200bnna", "A\x9b", "a" * 61]
)
def test_a_name_that_hides_something_is_refused(name: str) -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        register = scene.services.access.register
        (owner,) = register.people
        person = {"name": name, "role": "owner"}
        for method, path, body in (
            ("POST", "access/invitations", person),
            ("PUT", f"access/people/{owner}", person),
            ("POST", "access/keys", {"name": name, "scopes": ["read"]}),
            ("PUT", "vehicles/zoe", {"name": name + 20 * name[:1]}),
        ):
            answer = await client.request(method, path, json=body)
            (fault,) = problem(answer, 422, "invalid_request")["context"]["fields"]
            assert fault["field"] == "name"
        assert register.people[owner].name == "Owner"

    at_the_gate(scenario, role=Role.OWNER)


@pytest.mark.parametrize("name", ["Zoë", "奶奶", "علی‌رضا", "👩‍🔧", "O'Brien", "a" * 60])
def test_a_name_of_any_language_is_taken(name: str) -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        made = await client.post("access/invitations", json={"name": name, "role": "viewer"})
        assert made.status_code == 201, made.text

    at_the_gate(scenario, role=Role.OWNER)


def test_every_answer_has_the_headers_that_keep_browsers_careful() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for path in ("health", "robot", "nothing", "/", "/assets/none.js"):
            headers = (await client.get(path)).headers
            assert headers["x-content-type-options"] == "nosniff", path
            assert headers["x-frame-options"] == "SAMEORIGIN"
            assert headers["cross-origin-resource-policy"] == "same-origin"
            assert headers["cross-origin-opener-policy"] == "same-origin"
            assert headers["content-security-policy"].startswith("default-src 'none'")
            assert "unsafe" not in headers["content-security-policy"]
            assert "camera=()" in headers["permissions-policy"]
            assert "server" not in headers
            assert not any(name.startswith("access-control") for name in headers)
            assert "strict-transport-security" not in headers, "only where it was asked for"

    at_the_gate(scenario)


def test_the_cookie_is_for_this_server_alone() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        secret = await scene.services.access.pairing.invite_owner(address="")
        answer = await client.post("access/pairing", json={"secret": secret})
        parts = [part.strip().lower() for part in answer.headers["set-cookie"].split(";")]
        assert parts[0].startswith("plugpilot=")
        assert {"httponly", "samesite=strict", "path=/"} <= set(parts)
        assert not any(part.startswith("domain") for part in parts)
        assert secret not in answer.text
        assert parts[0].removeprefix("plugpilot=") not in answer.text.lower()

    at_the_gate(scenario)


def test_over_https_the_cookie_stays_there() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        secret = await scene.services.access.pairing.invite_owner(address="")
        answer = await client.post(
            "https://robot:8443/api/v1/access/pairing", json={"secret": secret}
        )
        cookie = answer.headers["set-cookie"].lower()
        assert cookie.startswith("__host-plugpilot-8443=")
        assert "; secure" in cookie

    at_the_gate(scenario)
