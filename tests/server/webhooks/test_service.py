"""The queue of deliveries, in virtual time: retries, restarts, bounds."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from server.config.webhooks import WebhookSettings as Limits
from server.control.model import PlugState
from server.events import EventLog
from server.schema.events import EventType, PlugChanged, PlugMoved
from server.schema.webhooks import WebhookSettings
from server.storage.database import Database
from server.storage.deliveries import DeliveryStore
from server.storage.webhooks import StoredWebhook, WebhookStore
from server.timing import Calendar
from server.webhooks.errors import (
    ForbiddenTargetError,
    TooManyWebhooksError,
    WebhookNotFoundError,
)
from server.webhooks.sending import Outcome
from server.webhooks.service import Webhooks
from tests.server.webhooks.receiver import BAD, GONE, GOOD, LOOPBACK, FakeSender
from tests.support.virtual import run_virtual

URL = "http://127.0.0.1:9/hook"


@dataclass
class Office:
    """Webhooks whose deliveries go nowhere."""

    webhooks: Webhooks
    events: EventLog
    sender: FakeSender
    calendar: Calendar

    async def add(self, url: str = URL, *events: EventType) -> StoredWebhook:
        wanted = list(events) or ["plug.changed"]
        return await self.webhooks.add(WebhookSettings(url=url, events=wanted))

    def happen(self) -> str:
        event = PlugChanged(
            id=self.events.new_id(),
            timestamp=self.calendar.now(),
            data=PlugMoved(plug=PlugState.FREE, before=PlugState.PARKED),
        )
        self.events.tell(event)
        return event.id

    async def states(self, webhook: StoredWebhook) -> list[str]:
        found = await self.webhooks.log(webhook.id, before=None, limit=1000)
        return [delivery.state for delivery in found]


@asynccontextmanager
async def office(
    *outcomes: Outcome, folder: Path | None = None, limits: Limits | None = None
) -> AsyncIterator[Office]:
    holds = limits or Limits(allowed_networks=LOOPBACK)
    database = Database(folder)
    await database.open()
    events, sender, calendar = EventLog(), FakeSender(*(outcomes or (GOOD,))), Calendar()
    webhooks = Webhooks(
        store=WebhookStore(database),
        deliveries=DeliveryStore(database),
        events=events,
        sender=sender,
        settings=lambda: holds,
        calendar=calendar,
    )
    await webhooks.start()
    try:
        yield Office(webhooks, events, sender, calendar)
    finally:
        await webhooks.close()
        await database.close()


def virtually(scenario: Callable[[], Awaitable[None]]) -> None:
    run_virtual(scenario())


def test_an_event_goes_to_those_who_want_it() -> None:
    async def scenario() -> None:
        async with office() as o:
            wants = await o.add()
            other = await o.add("http://127.0.0.1:9/other", "job.ended")
            event_id = o.happen()
            await asyncio.sleep(1)
            (sent,) = o.sender.sent
            assert sent.url == URL
            assert sent.headers["webhook-id"] == event_id
            assert json.loads(sent.body)["data"] == {"plug": "free", "before": "parked"}
            assert await o.states(wants) == ["delivered"]
            assert await o.states(other) == []

    virtually(scenario)


def test_it_is_tried_again_after_growing_pauses_and_then_given_up() -> None:
    async def scenario() -> None:
        async with office(BAD) as o:
            webhook = await o.add()
            began_s = asyncio.get_running_loop().time()
            o.happen()
            await asyncio.sleep(40_000)
            pauses = [0.0, 5.0, 300.0, 1800.0, 7200.0, 18000.0]
            due = [sum(pauses[: n + 1]) for n in range(6)]
            assert [s.at_s - began_s for s in o.sender.sent] == pytest.approx(due, abs=1.0)
            assert await o.states(webhook) == ["failed"]
            (delivery,) = await o.webhooks.log(webhook.id, before=None, limit=9)
            assert [attempt.status for attempt in delivery.attempts] == [503] * 6
            assert delivery.next_at is None
            assert len({s.headers["webhook-id"] for s in o.sender.sent}) == 1
            stamps = [int(s.headers["webhook-timestamp"]) for s in o.sender.sent]
            assert stamps == sorted(set(stamps)), "each attempt is signed anew"
            assert len({s.headers["webhook-signature"] for s in o.sender.sent}) == 6

    virtually(scenario)


def test_what_waits_survives_a_restart(tmp_path: Path) -> None:
    async def before() -> None:
        async with office(BAD, folder=tmp_path) as o:
            await o.add()
            o.happen()
            await asyncio.sleep(20)
            assert len(o.sender.sent) == 2
            o.happen()  # at the last moment: nobody has even written it down yet

    async def after() -> None:
        async with office(GOOD, folder=tmp_path) as o:
            (webhook,) = await o.webhooks.all(after=None, limit=9)
            await asyncio.sleep(400)
            assert len(o.sender.sent) == 2
            assert await o.states(webhook) == ["delivered", "delivered"]
            (_, first) = await o.webhooks.log(webhook.id, before=None, limit=9)
            assert [attempt.status for attempt in first.attempts] == [503, 503, 204]

    virtually(before)
    virtually(after)


def test_gone_switches_the_webhook_off() -> None:
    async def scenario() -> None:
        async with office(BAD, GONE) as o:
            webhook = await o.add()
            o.happen()
            await asyncio.sleep(1)
            o.happen()
            await asyncio.sleep(100)
            known = await o.webhooks.get(webhook.id)
            assert not known.settings.enabled
            assert "410" in str(known.disabled_reason)
            assert sorted(await o.states(webhook)) == ["dropped", "failed"]
            count = len(o.sender.sent)
            o.happen()
            await asyncio.sleep(100)
            assert len(o.sender.sent) == count

            o.sender.outcomes = [GOOD]
            again = await o.webhooks.change(webhook.id, webhook.settings)
            assert again.disabled_reason is None
            o.happen()
            await asyncio.sleep(1)
            assert len(o.sender.sent) == count + 1

    virtually(scenario)


def test_a_slow_target_holds_up_nobody_else() -> None:
    async def scenario() -> None:
        async with office() as o:
            await o.add("http://127.0.0.1:9/slow")
            await o.add("http://127.0.0.1:9/quick")
            o.sender.slow["http://127.0.0.1:9/slow"] = 10.0
            for _ in range(5):
                o.happen()
            await asyncio.sleep(1)
            urls = [sent.url.rpartition("/")[2] for sent in o.sender.sent]
            assert sorted(urls) == ["quick"] * 5 + ["slow"]

    virtually(scenario)


def test_queue_and_log_are_bounded() -> None:
    limits = Limits(allowed_networks=LOOPBACK, max_waiting=4, max_log=6, retry_after_s=(0.0, 60.0))

    async def scenario() -> None:
        async with office(BAD, limits=limits) as o:
            webhook = await o.add()
            for _ in range(30):
                o.happen()
                await asyncio.sleep(0.1)
            states = await o.states(webhook)
            assert states.count("waiting") <= 4
            assert states[0] == "waiting", "the newest stay"
            await asyncio.sleep(1000)
            assert len(await o.states(webhook)) <= 6

    virtually(scenario)


def test_another_secret_signs_from_now_on() -> None:
    async def scenario() -> None:
        async with office() as o:
            webhook = await o.add()
            rotated = await o.webhooks.rotate_secret(webhook.id)
            assert rotated.secret != webhook.secret
            assert rotated.secret.startswith("whsec_")
            o.happen()
            await asyncio.sleep(1)
            assert len(o.sender.sent) == 1

    virtually(scenario)


def test_what_cannot_be_a_webhook_is_refused() -> None:
    limits = Limits(allowed_networks=LOOPBACK, max_webhooks=2)

    async def scenario() -> None:
        async with office(limits=limits) as o:
            with pytest.raises(ForbiddenTargetError):
                await o.add("http://10.0.0.1/")
            webhook = await o.add()
            changed = WebhookSettings(url="http://[::1]/", events=["job.ended"])
            with pytest.raises(ForbiddenTargetError):
                await o.webhooks.change(webhook.id, changed)
            await o.add()
            with pytest.raises(TooManyWebhooksError):
                await o.add()
            await o.webhooks.delete(webhook.id)
            with pytest.raises(WebhookNotFoundError):
                await o.webhooks.get(webhook.id)
            assert len(await o.webhooks.all(after=None, limit=9)) == 1

    virtually(scenario)


def test_a_bug_in_the_sender_ends_no_queue(caplog: pytest.LogCaptureFixture) -> None:
    class Broken(FakeSender):
        async def send(self, *args: object, **kwargs: object) -> Outcome:
            del args, kwargs
            self.calls = getattr(self, "calls", 0) + 1
            if self.calls == 1:
                raise ZeroDivisionError("a bug")
            return GOOD

    async def scenario() -> None:
        async with office() as o:
            o.webhooks._sender = Broken(GOOD)
            webhook = await o.add()
            o.happen()
            await asyncio.sleep(100)
            assert await o.states(webhook) == ["delivered"]
            assert "a bug" in caplog.text

    virtually(scenario)


def test_a_name_that_hangs_holds_up_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    async def hang(*_: object) -> None:
        await asyncio.Event().wait()

    async def scenario() -> None:
        async with office() as o:
            began_s = asyncio.get_running_loop().time()
            monkeypatch.setattr("server.webhooks.service.admit", hang)
            webhook = await o.add("https://slow.example/")
            assert asyncio.get_running_loop().time() - began_s < 6.0
            assert (await o.webhooks.get(webhook.id)).settings.enabled

    virtually(scenario)
