"""The tables of notifications: which device is told where, and the key that signs."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import ForeignKey, LargeBinary, String
from sqlalchemy.orm import Mapped, mapped_column

from server.storage.tables import Base


class PushKeyRow(Base):
    """The robot's key at push services: one row."""

    __tablename__ = "push_keys"

    id: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    # In the clear: signing needs it. The data folder belongs to PlugPilot alone.
    private_key: Mapped[bytes] = mapped_column(LargeBinary)


class PushSubscriptionRow(Base):
    """Where one device is notified; it goes with the device."""

    __tablename__ = "push_subscriptions"

    device_id: Mapped[str] = mapped_column(
        ForeignKey("devices.id", ondelete="CASCADE"), primary_key=True
    )
    endpoint: Mapped[str] = mapped_column(String(2000))
    public_key: Mapped[bytes] = mapped_column(LargeBinary)
    auth_secret: Mapped[bytes] = mapped_column(LargeBinary)
    language: Mapped[str] = mapped_column(String(8))
    created_at: Mapped[datetime]
