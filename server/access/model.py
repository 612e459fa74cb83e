"""People, devices, keys, invitations, and whoever is at the door right now."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from server.access.rights import NO_RIGHTS, ROLE_RIGHTS, SCOPE_RIGHTS, Need, Rights, Role, Scope


@dataclass(frozen=True, slots=True)
class Person:
    """Somebody who may do something, until `ends_at` if that is set."""

    id: str
    name: str
    role: Role
    created_at: datetime
    ends_at: datetime | None = None

    def rights(self, now: datetime) -> Rights:
        """What the person may do now."""
        if self.ends_at is not None and now >= self.ends_at:
            return NO_RIGHTS
        return ROLE_RIGHTS[self.role]


@dataclass(frozen=True, slots=True)
class Device:
    """A browser of a person."""

    id: str
    person_id: str
    name: str
    digest: str
    created_at: datetime
    last_used_at: datetime
    last_from: str


@dataclass(frozen=True, slots=True)
class ApiKey:
    """A key for a machine."""

    id: str
    name: str
    hint: str
    digest: str
    scopes: tuple[Scope, ...]
    created_by: str
    created_at: datetime
    last_used_at: datetime | None = None
    last_from: str | None = None

    @property
    def rights(self) -> Rights:
        """What its scopes allow together."""
        return NO_RIGHTS.union(*(SCOPE_RIGHTS[scope] for scope in self.scopes))


@dataclass(frozen=True, slots=True)
class Invitation:
    """A one-time address, of which only the digest is known."""

    id: str
    name: str
    role: Role
    created_by: str
    created_at: datetime
    expires_at: datetime
    ends_at: datetime | None = None
    person_id: str | None = None
    used_at: datetime | None = None

    def is_open(self, now: datetime) -> bool:
        """Whether it can still be used."""
        return self.used_at is None and now < self.expires_at


@dataclass(frozen=True, slots=True)
class Passkey:
    """A passkey of a person."""

    id: str
    person_id: str
    name: str
    credential_id: bytes
    public_key: bytes
    sign_count: int
    created_at: datetime
    last_used_at: datetime | None = None


@dataclass(frozen=True, slots=True)
class Origin:
    """Where the page is, as its browser names it.

    Attributes:
        url: Such as https://robot.local:8443.
        host: Such as robot.local, the name that passkeys belong to.
    """

    url: str
    host: str


CallerKind = Literal["person", "key", "machine", "unknown"]


@dataclass(frozen=True, slots=True)
class Caller:
    """Who makes a request.

    Attributes:
        kind: A person's browser, a key, the machine itself without either, or nobody we know.
        id: Of the device or the key; empty for others.
        name: For people to read.
        rights: What the caller may do at this moment.
        address: Where the request came from.
        person: The person, if one is known.
    """

    kind: CallerKind
    id: str
    name: str
    rights: Rights
    address: str
    person: Person | None = None

    def may(self, need: Need) -> bool:
        """Whether the caller has what an operation needs."""
        return need in self.rights

    @property
    def label(self) -> str:
        """Kind and name, for the audit trail."""
        return f"{self.kind}: {self.name}" if self.name else self.kind
