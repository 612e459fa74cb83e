"""The tables of people, their devices, keys, invitations, passkeys and of the audit trail.

Of every secret only the SHA-256 digest is kept: all of them are random and at least 128 bits long,
so a digest tells nothing.
"""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, ForeignKey, LargeBinary, String
from sqlalchemy.orm import Mapped, mapped_column

from server.storage.tables import Base

_DIGEST = String(64)
_ID = String(36)


class PersonRow(Base):
    """Somebody who may do something."""

    __tablename__ = "people"

    id: Mapped[str] = mapped_column(_ID, primary_key=True)
    name: Mapped[str] = mapped_column(String(80))
    role: Mapped[str] = mapped_column(String(16))
    created_at: Mapped[datetime]
    ends_at: Mapped[datetime | None]


class DeviceRow(Base):
    """A browser of a person, with the session that its cookie names."""

    __tablename__ = "devices"

    id: Mapped[str] = mapped_column(_ID, primary_key=True)
    person_id: Mapped[str] = mapped_column(ForeignKey("people.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(80))
    digest: Mapped[str] = mapped_column(_DIGEST, unique=True)
    created_at: Mapped[datetime]
    last_used_at: Mapped[datetime]
    last_from: Mapped[str] = mapped_column(String(64))


class InvitationRow(Base):
    """A one-time address that makes a browser somebody's."""

    __tablename__ = "invitations"

    id: Mapped[str] = mapped_column(_ID, primary_key=True)
    digest: Mapped[str] = mapped_column(_DIGEST, unique=True)
    # Set when a person adds another device; otherwise using the invitation makes a person.
    person_id: Mapped[str | None] = mapped_column(ForeignKey("people.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(80))
    role: Mapped[str] = mapped_column(String(16))
    created_by: Mapped[str] = mapped_column(String(80))
    created_at: Mapped[datetime]
    expires_at: Mapped[datetime]
    ends_at: Mapped[datetime | None]
    used_at: Mapped[datetime | None]


class ApiKeyRow(Base):
    """A key for a machine."""

    __tablename__ = "api_keys"

    id: Mapped[str] = mapped_column(_ID, primary_key=True)
    name: Mapped[str] = mapped_column(String(80))
    hint: Mapped[str] = mapped_column(String(16))
    digest: Mapped[str] = mapped_column(_DIGEST, unique=True)
    scopes: Mapped[list[str]] = mapped_column(JSON)
    created_by: Mapped[str] = mapped_column(String(80))
    created_at: Mapped[datetime]
    last_used_at: Mapped[datetime | None]
    last_from: Mapped[str | None] = mapped_column(String(64))


class PasskeyRow(Base):
    """A passkey (WebAuthn credential) of a person."""

    __tablename__ = "passkeys"

    id: Mapped[str] = mapped_column(_ID, primary_key=True)
    person_id: Mapped[str] = mapped_column(ForeignKey("people.id", ondelete="CASCADE"))
    name: Mapped[str] = mapped_column(String(80))
    credential_id: Mapped[bytes] = mapped_column(LargeBinary, unique=True)
    public_key: Mapped[bytes] = mapped_column(LargeBinary)
    sign_count: Mapped[int]
    created_at: Mapped[datetime]
    last_used_at: Mapped[datetime | None]


class AuditRow(Base):
    """One entry of the audit trail. Triggers refuse every change of it (step 0003)."""

    __tablename__ = "audit"

    sequence: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    at: Mapped[datetime]
    event: Mapped[str] = mapped_column(String(40))
    actor: Mapped[str] = mapped_column(String(100))
    address: Mapped[str] = mapped_column(String(64))
    detail: Mapped[dict[str, Any]]
    times: Mapped[int] = mapped_column(default=1)
    chain: Mapped[str] = mapped_column(_DIGEST)
