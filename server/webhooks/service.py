"""All webhooks: makes, changes and forgets them, and gives each event to those who want it."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta

from server.config.webhooks import WebhookSettings as Limits
from server.events.log import EventLog, Told
from server.schema.events import Ping, PingEvent
from server.schema.webhooks import WebhookSettings
from server.storage.deliveries import DeliveryStore, StoredDelivery
from server.storage.errors import StorageError
from server.storage.webhooks import StoredWebhook, WebhookStore
from server.timing import Calendar
from server.webhooks.address import TargetRefusedError, TargetUnknownError, admit
from server.webhooks.delivering import Courier
from server.webhooks.errors import (
    ForbiddenTargetError,
    TooManyWebhooksError,
    WebhookNotFoundError,
)
from server.webhooks.sending import Sender
from server.webhooks.signing import new_secret

_log = logging.getLogger(__name__)

MAX_UNQUEUED = 1000
"""Events that wait for a slow disk; more are lost, and that is logged."""


class Webhooks:
    """Everything about webhooks.

    Args:
        store: Keeps the webhooks.
        deliveries: Keeps queue and log.
        events: Tells what happens.
        sender: Makes the attempts.
        settings: Gives what holds now.
        calendar: Dates.
        speed: Seconds of the event loop per second of the dates.
    """

    def __init__(
        self,
        *,
        store: WebhookStore,
        deliveries: DeliveryStore,
        events: EventLog,
        sender: Sender,
        settings: Callable[[], Limits],
        calendar: Calendar,
        speed: float = 1.0,
    ) -> None:
        self._store = store
        self._deliveries = deliveries
        self._events = events
        self._sender = sender
        self._settings = settings
        self._calendar = calendar
        self._speed = speed
        self._couriers: dict[str, Courier] = {}
        self._ends: set[asyncio.Task[None]] = set()
        self._unqueued: asyncio.Queue[Told] = asyncio.Queue(MAX_UNQUEUED)
        self._queueing: asyncio.Task[None] | None = None
        self._changing = asyncio.Lock()
        events.listen(self._happened)

    async def start(self) -> None:
        """Go on with what was waiting, and with what has happened since."""
        for webhook in await self._store.page(after=None, limit=1000):
            self._employ(webhook)
        self._queueing = asyncio.create_task(self._queue_all(), name="webhook queue")

    async def close(self) -> None:
        """Write down what has happened, and send no more."""
        if self._queueing is not None:
            self._queueing.cancel()
            await asyncio.wait([self._queueing])
            while not self._unqueued.empty():
                await self._queue(self._unqueued.get_nowait())
        couriers, self._couriers = list(self._couriers.values()), {}
        for courier in couriers:
            await courier.close()
        for task in self._ends:
            task.cancel()
        await self._sender.close()

    async def all(self, *, after: str | None, limit: int) -> list[StoredWebhook]:
        """Webhooks made after one, oldest first."""
        return await self._store.page(after=after, limit=limit)

    async def get(self, webhook_id: str) -> StoredWebhook:
        """One webhook.

        Raises:
            WebhookNotFoundError: there is none of that id.
        """
        webhook = await self._store.get(webhook_id)
        if webhook is None:
            raise WebhookNotFoundError(f"There is no webhook {webhook_id}.", webhook_id=webhook_id)
        return webhook

    async def add(self, settings: WebhookSettings) -> StoredWebhook:
        """Make a webhook with a new secret.

        Raises:
            TooManyWebhooksError: there are as many as the configuration allows.
            ForbiddenTargetError: its target may not be reached.
        """
        await self._refuse_forbidden(settings.url)
        async with self._changing:
            limit = self._settings().max_webhooks
            if await self._store.count() >= limit:
                raise TooManyWebhooksError(f"There are {limit} webhooks already.", limit=limit)
            webhook = StoredWebhook(
                id=self._events.new_id(),
                settings=settings,
                secret=new_secret(),
                created_at=self._calendar.now(),
            )
            await self._store.save(webhook)
            self._employ(webhook)
            return webhook

    async def change(
        self,
        webhook_id: str,
        settings: WebhookSettings,
        check: Callable[[StoredWebhook], None] = lambda _: None,
    ) -> StoredWebhook:
        """Change a webhook; what is waiting goes to the new target.

        Args:
            webhook_id: Which one.
            settings: What is to hold from now on.
            check: May refuse the change after a look at the webhook as it is.

        Raises:
            WebhookNotFoundError: there is none of that id.
            ForbiddenTargetError: its target may not be reached.
        """
        await self._refuse_forbidden(settings.url)
        async with self._changing:
            known = await self.get(webhook_id)
            check(known)
            return await self._put(known.changed(settings))

    async def rotate_secret(self, webhook_id: str) -> StoredWebhook:
        """Give a webhook another secret; the old one signs nothing any more.

        Raises:
            WebhookNotFoundError: there is none of that id.
        """
        async with self._changing:
            known = await self.get(webhook_id)
            return await self._put(replace(known, secret=new_secret(), version=known.version + 1))

    async def delete(
        self, webhook_id: str, check: Callable[[StoredWebhook], None] = lambda _: None
    ) -> None:
        """Forget a webhook and its deliveries.

        Raises:
            WebhookNotFoundError: there is none of that id.
        """
        async with self._changing:
            check(await self.get(webhook_id))
            await self._dismiss(webhook_id)
            await self._store.delete(webhook_id)

    async def ping(self, webhook_id: str) -> StoredDelivery:
        """Queue an event that means nothing, to try the webhook out.

        Raises:
            WebhookNotFoundError: there is none of that id.
        """
        webhook = await self.get(webhook_id)
        event = PingEvent(
            id=self._events.new_id(),
            timestamp=self._calendar.now(),
            data=Ping(message="This is a test."),
        )
        delivery = self._delivery(webhook, Told(event, event.model_dump_json()))
        if not webhook.settings.enabled:
            delivery = replace(delivery, state="dropped", next_at=None)
        await self._add([delivery])
        return delivery

    async def log(self, webhook_id: str, *, before: str | None, limit: int) -> list[StoredDelivery]:
        """Deliveries of a webhook older than one, newest first.

        Raises:
            WebhookNotFoundError: there is none of that id.
        """
        await self.get(webhook_id)
        return await self._deliveries.page(webhook_id, before=before, limit=limit)

    async def _refuse_forbidden(self, url: str) -> None:
        try:
            await admit(url, self._settings().allowed_networks)
        except TargetRefusedError as error:
            raise ForbiddenTargetError(str(error)) from error
        except TargetUnknownError:
            return  # it may come; each attempt looks again

    async def _put(self, webhook: StoredWebhook) -> StoredWebhook:
        await self._store.save(webhook)
        await self._dismiss(webhook.id)
        if not webhook.settings.enabled:
            await self._deliveries.drop_waiting(webhook.id)
        self._employ(webhook)
        return webhook

    def _employ(self, webhook: StoredWebhook) -> None:
        if not webhook.settings.enabled:
            return
        courier = self._couriers[webhook.id] = Courier(
            webhook,
            deliveries=self._deliveries,
            sender=self._sender,
            settings=self._settings,
            calendar=self._calendar,
            speed=self._speed,
        )
        end = asyncio.create_task(self._until_gone(courier), name=f"end of {webhook.id}")
        self._ends.add(end)
        end.add_done_callback(self._ends.discard)

    async def _dismiss(self, webhook_id: str) -> None:
        courier = self._couriers.pop(webhook_id, None)
        if courier is not None:
            await courier.close()

    async def _until_gone(self, courier: Courier) -> None:
        await courier.gone.wait()
        async with self._changing:
            if self._couriers.get(courier.webhook.id) is courier:
                await self._put(courier.webhook.switched_off("The target answered 410 Gone."))

    def _happened(self, told: Told) -> None:
        try:
            self._unqueued.put_nowait(told)
        except asyncio.QueueFull:
            _log.error("the event %s is lost to webhooks: the disk is too slow", told.event.id)

    async def _queue_all(self) -> None:
        while True:
            await self._queue(await self._unqueued.get())

    async def _queue(self, told: Told) -> None:
        wanted_by = [
            courier.webhook
            for courier in self._couriers.values()
            if told.event.type in courier.webhook.settings.events
        ]
        if not wanted_by:
            return
        try:
            await self._add([self._delivery(webhook, told) for webhook in wanted_by])
        except StorageError as error:
            _log.warning("the event %s is lost to webhooks: %s", told.event.id, error)

    async def _add(self, deliveries: list[StoredDelivery]) -> None:
        await self._deliveries.add(deliveries, max_waiting=self._settings().max_waiting)
        for delivery in deliveries:
            courier = self._couriers.get(delivery.webhook_id)
            if courier is not None:
                courier.wake()

    def _delivery(self, webhook: StoredWebhook, told: Told) -> StoredDelivery:
        now = self._calendar.now()
        return StoredDelivery(
            id=self._events.new_id(),
            webhook_id=webhook.id,
            event_id=told.event.id,
            event_type=told.event.type,
            body=told.json,
            created_at=now,
            next_at=now + timedelta(seconds=self._settings().retry_after_s[0]),
        )
