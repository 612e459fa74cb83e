"""Keeps people, devices, keys, invitations and passkeys in the database."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import delete, select, update
from sqlalchemy.orm import Session

from server.access.model import ApiKey, Device, Invitation, Passkey, Person
from server.access.rights import Role, Scope
from server.storage.access_tables import (
    ApiKeyRow,
    DeviceRow,
    InvitationRow,
    PasskeyRow,
    PersonRow,
)
from server.storage.database import Database

Entry = Person | Device | ApiKey | Passkey

_ROWS = {Person: PersonRow, Device: DeviceRow, ApiKey: ApiKeyRow, Passkey: PasskeyRow}


class AccessStore:
    """What is known about who may do what, on disk."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def everything(
        self,
    ) -> tuple[list[Person], list[Device], list[ApiKey], list[Passkey]]:
        """All people, devices, keys and passkeys."""

        def work(
            session: Session,
        ) -> tuple[list[Person], list[Device], list[ApiKey], list[Passkey]]:
            return (
                [_person(row) for row in session.scalars(select(PersonRow))],
                [_device(row) for row in session.scalars(select(DeviceRow))],
                [_key(row) for row in session.scalars(select(ApiKeyRow))],
                [_passkey(row) for row in session.scalars(select(PasskeyRow))],
            )

        return await self._database.run(work)

    async def put(self, *entries: Entry) -> None:
        """Add or change entries, all or none."""

        def work(session: Session) -> None:
            for entry in entries:
                session.merge(_row(entry))
                session.flush()  # in this order: a device needs its person

        await self._database.run(work)

    async def remove(self, entry: Entry) -> None:
        """Forget an entry; a person takes devices, passkeys and invitations along."""

        def work(session: Session) -> None:
            row = session.get(_ROWS[type(entry)], entry.id)
            if row is not None:
                session.delete(row)

        await self._database.run(work)

    async def invitations(self) -> list[Invitation]:
        """All invitations that were not used, oldest first."""

        def work(session: Session) -> list[Invitation]:
            query = (
                select(InvitationRow)
                .where(InvitationRow.used_at.is_(None))
                .order_by(InvitationRow.created_at)
            )
            return [_invitation(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def add_invitation(self, invitation: Invitation, secret_digest: str) -> None:
        """Keep an invitation; what is long over makes room."""

        def work(session: Session) -> None:
            for old in session.scalars(
                select(InvitationRow).where(InvitationRow.expires_at < invitation.created_at)
            ):
                session.delete(old)
            session.add(
                InvitationRow(
                    id=invitation.id,
                    digest=secret_digest,
                    person_id=invitation.person_id,
                    name=invitation.name,
                    role=invitation.role.value,
                    created_by=invitation.created_by,
                    created_at=invitation.created_at,
                    expires_at=invitation.expires_at,
                    ends_at=invitation.ends_at,
                    used_at=invitation.used_at,
                )
            )

        await self._database.run(work)

    async def withdraw_all(self, created_by: str) -> None:
        """Forget every open invitation of somebody."""

        def work(session: Session) -> None:
            query = delete(InvitationRow).where(
                InvitationRow.created_by == created_by, InvitationRow.used_at.is_(None)
            )
            session.execute(query)

        await self._database.run(work)

    async def use_invitation(self, secret_digest: str, now: datetime) -> Invitation | None:
        """Take an open invitation once; None for any other. Two at a time get it once."""

        def work(session: Session) -> Invitation | None:
            row = session.scalar(select(InvitationRow).where(InvitationRow.digest == secret_digest))
            if row is None or not _invitation(row).is_open(now):
                return None
            taken = session.execute(
                update(InvitationRow)
                .where(InvitationRow.id == row.id, InvitationRow.used_at.is_(None))
                .values(used_at=now)
            )
            return _invitation(row) if taken.rowcount == 1 else None  # type: ignore[attr-defined]

        return await self._database.run(work)

    async def withdraw_invitation(self, invitation_id: str) -> Invitation | None:
        """Forget an invitation that was not used; None when there is none."""

        def work(session: Session) -> Invitation | None:
            row = session.get(InvitationRow, invitation_id)
            if row is None or row.used_at is not None:
                return None
            invitation = _invitation(row)
            session.delete(row)
            return invitation

        return await self._database.run(work)


def _row(entry: Entry) -> PersonRow | DeviceRow | ApiKeyRow | PasskeyRow:
    values = {name: getattr(entry, name) for name in type(entry).__slots__}
    if isinstance(entry, Person):
        return PersonRow(**values | {"role": entry.role.value})
    if isinstance(entry, ApiKey):
        return ApiKeyRow(**values | {"scopes": [scope.value for scope in entry.scopes]})
    return DeviceRow(**values) if isinstance(entry, Device) else PasskeyRow(**values)


def _person(row: PersonRow) -> Person:
    return Person(row.id, row.name, Role(row.role), row.created_at, row.ends_at)


def _device(row: DeviceRow) -> Device:
    return Device(
        id=row.id,
        person_id=row.person_id,
        name=row.name,
        digest=row.digest,
        created_at=row.created_at,
        last_used_at=row.last_used_at,
        last_from=row.last_from,
    )


def _key(row: ApiKeyRow) -> ApiKey:
    return ApiKey(
        id=row.id,
        name=row.name,
        hint=row.hint,
        digest=row.digest,
        scopes=tuple(Scope(scope) for scope in row.scopes),
        created_by=row.created_by,
        created_at=row.created_at,
        last_used_at=row.last_used_at,
        last_from=row.last_from,
    )


def _passkey(row: PasskeyRow) -> Passkey:
    return Passkey(
        id=row.id,
        person_id=row.person_id,
        name=row.name,
        credential_id=row.credential_id,
        public_key=row.public_key,
        sign_count=row.sign_count,
        created_at=row.created_at,
        last_used_at=row.last_used_at,
    )


def _invitation(row: InvitationRow) -> Invitation:
    return Invitation(
        id=row.id,
        name=row.name,
        role=Role(row.role),
        created_by=row.created_by,
        created_at=row.created_at,
        expires_at=row.expires_at,
        ends_at=row.ends_at,
        person_id=row.person_id,
        used_at=row.used_at,
    )
