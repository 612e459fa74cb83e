"""Keeps what is to be delivered to webhooks, and what came of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime

from sqlalchemy import delete, func, select, update
from sqlalchemy.orm import Session

from server.schema.webhooks import Attempt, Delivery, DeliveryState
from server.storage.database import Database
from server.storage.integration_tables import DeliveryRow

WAITING: DeliveryState = "waiting"
DROPPED: DeliveryState = "dropped"


@dataclass(frozen=True, slots=True)
class StoredDelivery:
    """One event for one webhook.

    Attributes:
        id: Of the delivery; sorts by time.
        webhook_id: Who gets it.
        event_id: Which event.
        event_type: Of which kind.
        body: What is sent.
        created_at: When it was queued.
        next_at: When the next attempt is due; None once it has ended.
        state: How far it is.
        attempts: What was tried.
    """

    id: str
    webhook_id: str
    event_id: str
    event_type: str
    body: str
    created_at: datetime
    next_at: datetime | None
    state: DeliveryState = WAITING
    attempts: Sequence[Attempt] = field(default_factory=tuple)

    @property
    def shown(self) -> Delivery:
        """As the log shows it."""
        return Delivery(
            id=self.id,
            event_id=self.event_id,
            event_type=self.event_type,
            state=self.state,
            created_at=self.created_at,
            next_attempt_at=self.next_at,
            attempts=list(self.attempts),
        )


class DeliveryStore:
    """The queue and the log of all webhooks; both are bounded."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def add(self, deliveries: Sequence[StoredDelivery], *, max_waiting: int) -> None:
        """Queue deliveries; of each webhook the oldest ones give way where too many wait."""

        def work(session: Session) -> None:
            session.add_all([_row(delivery) for delivery in deliveries])
            session.flush()
            for webhook_id in {delivery.webhook_id for delivery in deliveries}:
                _drop_beyond(session, webhook_id, max_waiting)

        await self._database.run(work)

    async def next_waiting(self, webhook_id: str) -> StoredDelivery | None:
        """The delivery of a webhook that is due first."""

        def work(session: Session) -> StoredDelivery | None:
            row = session.scalar(
                select(DeliveryRow)
                .where(DeliveryRow.webhook_id == webhook_id, DeliveryRow.state == WAITING)
                .order_by(DeliveryRow.next_at, DeliveryRow.id)
                .limit(1)
            )
            return None if row is None else _read(row)

        return await self._database.run(work)

    async def save(self, delivery: StoredDelivery, *, max_log: int) -> None:
        """Keep what came of an attempt, and no more ended deliveries than that of its webhook."""

        def work(session: Session) -> None:
            row = session.get(DeliveryRow, delivery.id)
            if row is None:
                return  # its webhook was deleted meanwhile
            row.state = delivery.state
            row.next_at = delivery.next_at
            row.attempts = [attempt.model_dump(mode="json") for attempt in delivery.attempts]
            session.flush()
            _forget_beyond(session, delivery.webhook_id, max_log)

        await self._database.run(work)

    async def drop_waiting(self, webhook_id: str) -> None:
        """Nothing more is to be sent to a webhook."""

        def work(session: Session) -> None:
            session.execute(
                update(DeliveryRow)
                .where(DeliveryRow.webhook_id == webhook_id, DeliveryRow.state == WAITING)
                .values(state=DROPPED, next_at=None)
            )

        await self._database.run(work)

    async def page(
        self, webhook_id: str, *, before: str | None, limit: int
    ) -> list[StoredDelivery]:
        """Up to ``limit`` deliveries older than ``before``, newest first."""

        def work(session: Session) -> list[StoredDelivery]:
            query = (
                select(DeliveryRow)
                .where(DeliveryRow.webhook_id == webhook_id)
                .order_by(DeliveryRow.id.desc())
                .limit(limit)
            )
            if before is not None:
                query = query.where(DeliveryRow.id < before)
            return [_read(row) for row in session.scalars(query)]

        return await self._database.run(work)


def _drop_beyond(session: Session, webhook_id: str, max_waiting: int) -> None:
    is_waiting = (DeliveryRow.webhook_id == webhook_id, DeliveryRow.state == WAITING)
    count = session.scalar(select(func.count()).select_from(DeliveryRow).where(*is_waiting)) or 0
    if count > max_waiting:
        oldest = select(DeliveryRow.id).where(*is_waiting).order_by(DeliveryRow.id)
        ids = list(session.scalars(oldest.limit(count - max_waiting)))
        session.execute(
            update(DeliveryRow)
            .where(DeliveryRow.id.in_(ids))
            .values(state=DROPPED, next_at=None)
            .execution_options(synchronize_session=False)
        )


def _forget_beyond(session: Session, webhook_id: str, max_log: int) -> None:
    has_ended = (DeliveryRow.webhook_id == webhook_id, DeliveryRow.state != WAITING)
    newest_first = select(DeliveryRow.id).where(*has_ended).order_by(DeliveryRow.id.desc())
    too_old = list(session.scalars(newest_first.offset(max_log)))
    if too_old:
        session.execute(
            delete(DeliveryRow)
            .where(DeliveryRow.id.in_(too_old))
            .execution_options(synchronize_session=False)
        )


def _row(delivery: StoredDelivery) -> DeliveryRow:
    return DeliveryRow(
        id=delivery.id,
        webhook_id=delivery.webhook_id,
        event_id=delivery.event_id,
        event_type=delivery.event_type,
        body=delivery.body,
        state=delivery.state,
        created_at=delivery.created_at,
        next_at=delivery.next_at,
        attempts=[attempt.model_dump(mode="json") for attempt in delivery.attempts],
    )


def _read(row: DeliveryRow) -> StoredDelivery:
    return StoredDelivery(
        id=row.id,
        webhook_id=row.webhook_id,
        event_id=row.event_id,
        event_type=row.event_type,
        body=row.body,
        created_at=row.created_at,
        next_at=row.next_at,
        state=row.state,  # type: ignore[arg-type]  # written from the same words
        attempts=tuple(Attempt.model_validate(attempt) for attempt in row.attempts),
    )
