"""Keeps webhooks: who wants to be told what."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server.schema.webhooks import Webhook, WebhookSettings
from server.storage.database import Database
from server.storage.integration_tables import WebhookRow


@dataclass(frozen=True, slots=True)
class StoredWebhook:
    """A webhook with what is not shown of it.

    Attributes:
        id: Of the webhook.
        settings: What its owner said.
        secret: Signs what is sent.
        disabled_reason: Why PlugPilot switched it off, if it did.
        created_at: When it was made.
        version: Raised with every change.
    """

    id: str
    settings: WebhookSettings
    secret: str
    created_at: datetime
    disabled_reason: str | None = None
    version: int = 1

    @property
    def shown(self) -> Webhook:
        """As everyone may see it."""
        return Webhook(
            **self.settings.model_dump(),
            id=self.id,
            disabled_reason=self.disabled_reason,
            created_at=self.created_at,
        )

    def changed(self, settings: WebhookSettings) -> StoredWebhook:
        """The same with other settings; switched on again, it starts afresh."""
        reason = None if settings.enabled else self.disabled_reason
        return replace(self, settings=settings, disabled_reason=reason, version=self.version + 1)

    def switched_off(self, reason: str) -> StoredWebhook:
        """The same, switched off by PlugPilot."""
        settings = self.settings.model_copy(update={"enabled": False})
        return replace(self, settings=settings, disabled_reason=reason, version=self.version + 1)


class WebhookStore:
    """Webhooks, oldest first."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def count(self) -> int:
        """How many there are."""

        def work(session: Session) -> int:
            return session.scalar(select(func.count()).select_from(WebhookRow)) or 0

        return await self._database.run(work)

    async def page(self, *, after: str | None, limit: int) -> list[StoredWebhook]:
        """Up to ``limit`` webhooks made after the one with that id."""

        def work(session: Session) -> list[StoredWebhook]:
            query = select(WebhookRow).order_by(WebhookRow.id).limit(limit)
            if after is not None:
                query = query.where(WebhookRow.id > after)
            return [_read(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def get(self, webhook_id: str) -> StoredWebhook | None:
        """One webhook, or None."""

        def work(session: Session) -> StoredWebhook | None:
            row = session.get(WebhookRow, webhook_id)
            return None if row is None else _read(row)

        return await self._database.run(work)

    async def save(self, webhook: StoredWebhook) -> None:
        """Keep a new or changed webhook."""

        def work(session: Session) -> None:
            session.merge(_row(webhook))

        await self._database.run(work)

    async def delete(self, webhook_id: str) -> bool:
        """Forget a webhook with all its deliveries; False when it was not known."""

        def work(session: Session) -> bool:
            row = session.get(WebhookRow, webhook_id)
            if row is None:
                return False
            session.delete(row)
            return True

        return await self._database.run(work)


def _row(webhook: StoredWebhook) -> WebhookRow:
    settings = webhook.settings
    return WebhookRow(
        id=webhook.id,
        url=settings.url,
        description=settings.description,
        events=list(settings.events),
        enabled=settings.enabled,
        disabled_reason=webhook.disabled_reason,
        secret=webhook.secret,
        created_at=webhook.created_at,
        version=webhook.version,
    )


def _read(row: WebhookRow) -> StoredWebhook:
    settings = WebhookSettings.model_validate(
        {
            "url": row.url,
            "description": row.description,
            "events": row.events,
            "enabled": row.enabled,
        }
    )
    return StoredWebhook(
        id=row.id,
        settings=settings,
        secret=row.secret,
        created_at=row.created_at,
        disabled_reason=row.disabled_reason,
        version=row.version,
    )
