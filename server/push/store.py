"""Keeps which device is notified where, and the robot's key at push services."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from pydantic import TypeAdapter
from sqlalchemy import delete, select
from sqlalchemy.orm import Session

from server.schema.push import PushLanguage
from server.storage.database import Database
from server.storage.push_tables import PushKeyRow, PushSubscriptionRow

_ONLY_ROW = 1
_LANGUAGE: TypeAdapter[PushLanguage] = TypeAdapter(PushLanguage)


@dataclass(frozen=True, slots=True)
class Subscription:
    """Where one device is notified.

    Attributes:
        device_id: The paired device; removing it removes this, too.
        endpoint: At the push service of its browser.
        public_key: Of the browser, 65 bytes.
        auth_secret: Of the browser, 16 bytes.
        language: In which it wants to be told.
        created_at: Since when.
    """

    device_id: str
    endpoint: str
    public_key: bytes
    auth_secret: bytes
    language: PushLanguage
    created_at: datetime


class PushStore:
    """Subscriptions, one for each device, and the key."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def key(self, make: Callable[[], bytes]) -> bytes:
        """The private key of this installation, made when there is none yet."""

        def work(session: Session) -> bytes:
            row = session.get(PushKeyRow, _ONLY_ROW)
            if row is None:
                row = PushKeyRow(id=_ONLY_ROW, private_key=make())
                session.add(row)
            return row.private_key

        return await self._database.run(work)

    async def all(self) -> list[Subscription]:
        """Every subscription."""

        def work(session: Session) -> list[Subscription]:
            return [_read(row) for row in session.scalars(select(PushSubscriptionRow))]

        return await self._database.run(work)

    async def get(self, device_id: str) -> Subscription | None:
        """The subscription of a device."""

        def work(session: Session) -> Subscription | None:
            row = session.get(PushSubscriptionRow, device_id)
            return None if row is None else _read(row)

        return await self._database.run(work)

    async def put(self, subscription: Subscription) -> None:
        """Keep the subscription of a device in place of its older one."""

        def work(session: Session) -> None:
            session.merge(
                PushSubscriptionRow(
                    device_id=subscription.device_id,
                    endpoint=subscription.endpoint,
                    public_key=subscription.public_key,
                    auth_secret=subscription.auth_secret,
                    language=subscription.language,
                    created_at=subscription.created_at,
                )
            )

        await self._database.run(work)

    async def remove(self, device_id: str, endpoint: str | None = None) -> None:
        """Forget the subscription of a device; with an endpoint only if it is still that one."""

        def work(session: Session) -> None:
            query = delete(PushSubscriptionRow).where(PushSubscriptionRow.device_id == device_id)
            if endpoint is not None:
                query = query.where(PushSubscriptionRow.endpoint == endpoint)
            session.execute(query)

        await self._database.run(work)


def _read(row: PushSubscriptionRow) -> Subscription:
    return Subscription(
        device_id=row.device_id,
        endpoint=row.endpoint,
        public_key=row.public_key,
        auth_secret=row.auth_secret,
        language=_LANGUAGE.validate_python(row.language),
        created_at=row.created_at,
    )
