"""One attempt over a real socket: signed, bounded, and never led elsewhere."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from ipaddress import ip_address
from types import MappingProxyType

import pytest
from standardwebhooks import Webhook as Verifier
from standardwebhooks.webhooks import WebhookVerificationError

from server.config.webhooks import WebhookSettings
from server.webhooks.address import IpAddress
from server.webhooks.sending import HttpSender, Outcome
from server.webhooks.signing import new_secret, signed_headers
from tests.server.webhooks.receiver import LOOPBACK, OPEN, receiving
from tests.support.fake_stations.serving import answering, http

BODY = '{"type":"ping","id":"1"}'


async def attempt(
    url: str, settings: WebhookSettings = OPEN, headers: Mapping[str, str] = MappingProxyType({})
) -> Outcome:
    sender = HttpSender(lambda: settings)
    try:
        return await sender.send(url, BODY, headers)
    finally:
        await sender.close()


async def test_what_arrives_can_be_verified() -> None:
    secret = new_secret()
    async with receiving() as receiver:
        headers = signed_headers(secret, "event-1", datetime.now(UTC), BODY)
        outcome = await attempt(f"{receiver.url}/hook?x=1", headers=headers)
        assert outcome == Outcome(204, None)
        (received,) = receiver.received
        assert received.headers["content-type"] == "application/json"
        assert received.headers["user-agent"].startswith("PlugPilot/")
        assert received.headers["webhook-id"] == "event-1"
        assert Verifier(secret).verify(received.body, received.headers)["type"] == "ping"
        with pytest.raises(WebhookVerificationError):
            Verifier(new_secret()).verify(received.body, received.headers)
        with pytest.raises(WebhookVerificationError):
            Verifier(secret).verify(received.body + " ", received.headers)


async def test_a_redirect_is_a_failure_and_is_not_followed() -> None:
    async with receiving() as inside, receiving() as receiver:
        receiver.status, receiver.headers = 307, {"Location": f"{inside.url}/secret"}
        outcome = await attempt(receiver.url)
        assert outcome.status == 307
        assert outcome.error is not None
        assert "redirect" in outcome.error
        assert inside.received == []


async def test_a_target_that_hangs_is_given_up() -> None:
    settings = WebhookSettings(allowed_networks=LOOPBACK, timeout_s=0.3)
    async with receiving() as receiver:
        receiver.hangs = True
        outcome = await attempt(receiver.url, settings)
        assert outcome == Outcome(None, "No answer within 0.3 s.")
        assert len(receiver.received) == 1


async def test_a_name_that_hangs_is_given_up() -> None:
    async def never(host: str, port: int) -> Sequence[IpAddress]:
        del host, port
        await asyncio.Event().wait()
        return []

    sender = HttpSender(lambda: WebhookSettings(timeout_s=0.1), 1.0, never)
    assert (await sender.send("https://example.com", BODY, {})).status is None


async def test_an_endless_answer_is_not_read_to_its_end() -> None:
    async with receiving() as receiver:
        receiver.status, receiver.body = 200, b"x" * 5_000_000
        assert await attempt(receiver.url) == Outcome(200, None)


@pytest.mark.parametrize(
    "said", [b"hello", b"HTTP/1.1 999999 no\r\n\r\n", b"", http(b"{", length=9)]
)
async def test_nonsense_is_a_failure_in_words(said: bytes) -> None:
    async with answering(said) as url:
        outcome = await attempt(url)
        assert outcome.error is not None


async def test_what_changes_its_address_after_the_check_is_still_refused() -> None:
    """At each attempt the name is looked up once, and that very address is checked and used."""
    asked: list[str] = []

    async def rebinding(host: str, port: int) -> Sequence[IpAddress]:
        del port
        asked.append(host)
        return [ip_address("93.184.216.34" if len(asked) > 1 else "127.0.0.1")]

    sender = HttpSender(lambda: WebhookSettings(timeout_s=1), 1.0, rebinding)
    outcome = await sender.send("https://rebinding.example", BODY, {})
    assert outcome.status is None
    assert "allowed_networks" in str(outcome.error)
    assert asked == ["rebinding.example"]


async def test_nobody_there_is_a_failure_in_words() -> None:
    outcome = await attempt("http://127.0.0.1:1/")
    assert outcome.status is None
    assert "No connection" in str(outcome.error)
