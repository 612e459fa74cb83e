"""The tables of what other programs ask for: webhooks, the charge point, changed settings."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Float, ForeignKey, Index, String, Text
from sqlalchemy.orm import Mapped, mapped_column

from server.storage.tables import Base


class WebhookRow(Base):
    """Somebody who wants to be told what happens."""

    __tablename__ = "webhooks"

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    url: Mapped[str] = mapped_column(String(2000))
    description: Mapped[str] = mapped_column(String(200))
    events: Mapped[list[str]] = mapped_column(JSON)
    enabled: Mapped[bool]
    disabled_reason: Mapped[str | None] = mapped_column(String(300))
    # In the clear: signing needs it. The data folder belongs to PlugPilot alone.
    secret: Mapped[str] = mapped_column(String(100))
    created_at: Mapped[datetime]
    version: Mapped[int]


class DeliveryRow(Base):
    """One event for one webhook, waiting or ended."""

    __tablename__ = "webhook_deliveries"
    __table_args__ = (Index("deliveries_by_webhook", "webhook_id", "state", "next_at"),)

    id: Mapped[str] = mapped_column(String(36), primary_key=True)
    webhook_id: Mapped[str] = mapped_column(ForeignKey("webhooks.id", ondelete="CASCADE"))
    event_id: Mapped[str] = mapped_column(String(36))
    event_type: Mapped[str] = mapped_column(String(40))
    # As text: exactly these bytes are signed, in every attempt.
    body: Mapped[str] = mapped_column(Text)
    state: Mapped[str] = mapped_column(String(16))
    created_at: Mapped[datetime]
    next_at: Mapped[datetime | None]
    attempts: Mapped[list[dict[str, Any]]] = mapped_column(JSON)


class ChargePointRow(Base):
    """What energy managers and people last wanted of the charge point: one row."""

    __tablename__ = "charge_point"

    id: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    enabled: Mapped[bool]
    resting: Mapped[str | None] = mapped_column(String(16))
    failures: Mapped[int]
    max_current_a: Mapped[float | None] = mapped_column(Float)
    job_id: Mapped[str | None] = mapped_column(String(36))
    energy_wh: Mapped[float] = mapped_column(Float)
    session_wh: Mapped[float] = mapped_column(Float)


class ChangedSettingsRow(Base):
    """Settings that were changed while PlugPilot ran: what holds, and versions of the past."""

    __tablename__ = "changed_settings"

    id: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    values: Mapped[dict[str, Any]]
