"""Delivers the queue of one webhook: one after the other, again and again, across restarts."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import timedelta

from server.config.webhooks import WebhookSettings
from server.schema.webhooks import Attempt
from server.storage.deliveries import DeliveryStore, StoredDelivery
from server.storage.errors import StorageError
from server.storage.webhooks import StoredWebhook
from server.timing import Calendar
from server.webhooks.sending import Outcome, Sender
from server.webhooks.signing import signed_headers

_log = logging.getLogger(__name__)

TROUBLE_PAUSE_S = 30.0
"""After the disk has refused, or something nobody thought of, nothing is tried for so long."""


class Courier:
    """Works for one webhook. A slow target holds up only its own deliveries.

    Args:
        webhook: Whom to tell; replaced when it changes.
        deliveries: Its queue.
        sender: Makes the attempts.
        settings: Gives what holds now.
        calendar: Dates.
        speed: Seconds of the event loop per second of the dates.
    """

    def __init__(
        self,
        webhook: StoredWebhook,
        *,
        deliveries: DeliveryStore,
        sender: Sender,
        settings: Callable[[], WebhookSettings],
        calendar: Calendar,
        speed: float,
    ) -> None:
        self.webhook = webhook
        self.gone = asyncio.Event()
        self._deliveries = deliveries
        self._sender = sender
        self._settings = settings
        self._calendar = calendar
        self._speed = speed
        self._news = asyncio.Event()
        self._task = asyncio.create_task(self._run(), name=f"webhook {webhook.id}")

    def wake(self) -> None:
        """There is something new in the queue."""
        self._news.set()

    async def close(self) -> None:
        """Stop. An attempt under way counts as not made, and is repeated."""
        self._task.cancel()
        await asyncio.wait([self._task])
        self.gone.set()

    async def _run(self) -> None:
        while not self.gone.is_set():
            self._news.clear()
            try:
                delivery = await self._deliveries.next_waiting(self.webhook.id)
                wait_s = self._until_due_s(delivery)
                if delivery is not None and wait_s == 0.0:
                    await self._attempt(delivery)
                    continue
            except StorageError as error:
                _log.warning("the queue of webhook %s cannot be kept: %s", self.webhook.id, error)
                wait_s = TROUBLE_PAUSE_S * self._speed
            except Exception:  # noqa: BLE001 - logged; what comes later must still be delivered
                _log.exception("a delivery of webhook %s failed", self.webhook.id)
                wait_s = TROUBLE_PAUSE_S * self._speed
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(wait_s):
                    await self._news.wait()

    def _until_due_s(self, delivery: StoredDelivery | None) -> float | None:
        """Event loop time until it is due; None without one."""
        if delivery is None or delivery.next_at is None:
            return None
        wait = delivery.next_at - self._calendar.now()
        return max(wait.total_seconds(), 0.0) * self._speed

    async def _attempt(self, delivery: StoredDelivery) -> None:
        loop = asyncio.get_running_loop()
        webhook, at, began_s = self.webhook, self._calendar.now(), loop.time()
        headers = signed_headers(webhook.secret, delivery.event_id, at, delivery.body)
        outcome = await self._sender.send(webhook.settings.url, delivery.body, headers)
        duration_s = round((loop.time() - began_s) / self._speed, 3)
        made = Attempt(at=at, status=outcome.status, error=outcome.error, duration_s=duration_s)
        after = self._judge(delivery, outcome, [*delivery.attempts, made])
        await self._deliveries.save(after, max_log=self._settings().max_log)
        if outcome.error is not None:
            _log.info("webhook %s: %s", webhook.id, outcome.error)
        if outcome.gone:
            self.gone.set()

    def _judge(
        self, delivery: StoredDelivery, outcome: Outcome, attempts: Sequence[Attempt]
    ) -> StoredDelivery:
        tried = replace(delivery, attempts=tuple(attempts), next_at=None)
        pauses_s = self._settings().retry_after_s
        if outcome.error is None:
            return replace(tried, state="delivered")
        if outcome.gone or len(attempts) >= len(pauses_s):
            return replace(tried, state="failed")
        pause = timedelta(seconds=pauses_s[len(attempts)])
        return replace(tried, next_at=self._calendar.now() + pause)
