"""Tells phones what happens: each message encrypted for its device, and tried again for a while."""

from __future__ import annotations

import asyncio
import base64
import binascii
import importlib
import logging
from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol
from urllib.parse import urlsplit

from server.access.model import Person
from server.access.register import Register
from server.access.rights import Need
from server.config.push import PushSettings
from server.events import EventLog
from server.events.log import Told
from server.push.errors import PushRefusedError
from server.push.messages import Message, message_of
from server.push.store import PushStore, Subscription
from server.schema.push import PushState, PushSubscription
from server.storage.errors import StorageError
from server.timing import Calendar
from server.webhooks.address import TargetRefusedError, TargetUnknownError, admit, checked_url
from server.webhooks.sending import Outcome

if TYPE_CHECKING:
    from server.push.sealing import Sealer

_log = logging.getLogger(__name__)

NAME_TIMEOUT_S = 5.0
GONE = frozenset({404, 410})
"""The browser has ended its subscription (RFC 8030, 7.3)."""
WORTH_ANOTHER_TRY = frozenset({408, 425, 429, 500, 502, 503, 504})


class PushSender(Protocol):
    """Makes attempts."""

    async def post(self, url: str, content: bytes, headers: Mapping[str, str]) -> Outcome:
        """Make one. Ends within a bounded time and never raises."""
        ...

    async def close(self) -> None:
        """Drop all connections."""
        ...


class PushService:
    """Notifications on the devices of those who are known.

    A message that could not be delivered is tried again in memory only: after a restart it is old
    news. A newer one for the same device takes its place.

    Args:
        store: Keeps subscriptions and the key.
        register: Says who may still know.
        events: Tells what happens.
        sender: Makes the attempts.
        settings: Section `push` of the configuration.
        calendar: Dates.
        speed: Seconds of the event loop per second of the dates.
    """

    def __init__(
        self,
        *,
        store: PushStore,
        register: Register,
        events: EventLog,
        sender: PushSender,
        settings: PushSettings,
        calendar: Calendar,
        speed: float = 1.0,
    ) -> None:
        self._store = store
        self._register = register
        self._events = events
        self._sender = sender
        self._settings = settings
        self._calendar = calendar
        self._speed = speed
        self._sealer: Sealer | None = None
        self._telling: set[asyncio.Task[None]] = set()
        self._deliveries: dict[str, asyncio.Task[None]] = {}

    async def start(self) -> None:
        """Listen to what happens."""
        self._events.listen(self._happened)

    async def close(self) -> None:
        """Send no more."""
        tasks = [*self._telling, *self._deliveries.values()]
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks)
        await self._sender.close()

    async def state(self, device_id: str) -> PushState:
        """What a browser needs to subscribe, and whether it has."""
        sealer = await self._identity()
        subscription = await self._store.get(device_id)
        return PushState(public_key=sealer.public_key, subscribed=subscription is not None)

    async def subscribe(self, device_id: str, wanted: PushSubscription) -> None:
        """Tell a device what happens from now on.

        Raises:
            PushRefusedError: its browser names no push service that may be reached, or no keys.
        """
        public_key, auth_secret = _decoded(wanted.p256dh), _decoded(wanted.auth)
        if not (await self._identity()).fits(public_key, auth_secret):
            raise PushRefusedError("The keys of the browser are not those of a subscription.")
        await self._refuse_forbidden(wanted.endpoint)
        await self._store.put(
            Subscription(
                device_id=device_id,
                endpoint=wanted.endpoint,
                public_key=public_key,
                auth_secret=auth_secret,
                language=wanted.language,
                created_at=self._calendar.now(),
            )
        )

    async def unsubscribe(self, device_id: str) -> None:
        """Tell a device nothing any more."""
        self._forget_delivery(device_id)
        await self._store.remove(device_id)

    async def _identity(self) -> Sealer:
        if self._sealer is None:
            module = await asyncio.to_thread(importlib.import_module, "server.push.sealing")
            key = await self._store.key(module.new_key)
            self._sealer = module.Sealer(key, self._settings.contact)
        return self._sealer

    async def _refuse_forbidden(self, endpoint: str) -> None:
        try:
            if urlsplit(checked_url(endpoint)).scheme != "https":
                raise PushRefusedError("A push service is reached by https only.")
            async with asyncio.timeout(NAME_TIMEOUT_S * self._speed):
                await admit(endpoint, self._settings.allowed_networks)
        except (ValueError, TargetRefusedError) as error:
            raise PushRefusedError(f"The push service cannot be used: {error}") from error
        except (TargetUnknownError, TimeoutError):
            return  # it may come; each attempt looks again

    def _happened(self, told: Told) -> None:
        message = message_of(told.event)
        if message is None:
            return
        task = asyncio.get_running_loop().create_task(self._tell_all(message), name="push")
        self._telling.add(task)
        task.add_done_callback(self._telling.discard)

    async def _tell_all(self, message: Message) -> None:
        try:
            subscriptions = await self._store.all()
            if not subscriptions:
                return
            sealer = await self._identity()
        except StorageError as error:
            _log.warning("nobody could be notified: %s", error)
            return
        for subscription in subscriptions:
            if not self._may_know(subscription.device_id):
                continue
            device_id = subscription.device_id
            self._forget_delivery(device_id)
            self._deliveries[device_id] = asyncio.get_running_loop().create_task(
                self._deliver(subscription, message, sealer), name=f"push to {device_id}"
            )

    def _may_know(self, device_id: str) -> bool:
        """Removed devices are no longer in the table; rights can end before that."""
        device = self._register.devices.get(device_id)
        person: Person | None = self._register.people.get(device.person_id) if device else None
        return person is not None and Need.READ in person.rights(self._calendar.now())

    def _forget_delivery(self, device_id: str) -> None:
        task = self._deliveries.pop(device_id, None)
        if task is not None:
            task.cancel()

    async def _deliver(self, to: Subscription, message: Message, sealer: Sealer) -> None:
        body = sealer.body(message, to)
        for pause_s in self._settings.retry_after_s:
            await asyncio.sleep(pause_s * self._speed)
            if not self._may_know(to.device_id):
                return
            headers = sealer.headers(message, to, self._calendar.now())
            outcome = await self._sender.post(to.endpoint, body, headers)
            if outcome.error is None:
                return
            _log.info("a notification of device %s: %s", to.device_id, outcome.error)
            if outcome.status in GONE:
                await self._remove(to)
                return
            if outcome.status is not None and outcome.status not in WORTH_ANOTHER_TRY:
                return

    async def _remove(self, gone: Subscription) -> None:
        try:
            await self._store.remove(gone.device_id, gone.endpoint)
        except StorageError as error:
            _log.warning("an ended subscription could not be removed: %s", error)


def _decoded(text: str) -> bytes:
    """Bytes in base64url, with or without padding; nothing where they are none."""
    try:
        return base64.urlsafe_b64decode(text.rstrip("=") + "=" * (-len(text.rstrip("=")) % 4))
    except (binascii.Error, ValueError):
        return b""
