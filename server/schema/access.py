"""Models of access: sessions, people, devices, invitations, keys, passkeys, the audit trail."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field

from server.access.rights import Need, Role, Scope
from server.schema.base import READABLE, Timestamp, Wire

Name = Annotated[str, Field(min_length=1, max_length=60, pattern=READABLE, examples=["Anna"])]
NextCursor = Annotated[
    str | None, Field(description="Pass as ?cursor= for the next page; null: end")
]
Secret = Annotated[str, Field(min_length=1, max_length=200)]


class PersonSummary(Wire):
    """Who is paired."""

    id: str
    name: str
    role: Role
    ends_at: Timestamp | None = Field(description="When the rights end by themselves")


class AccessSession(Wire):
    """What this browser or program is to the robot."""

    paired: bool
    person: PersonSummary | None
    device_id: str | None
    rights: list[Need] = Field(description="What may be done, as in the table of operations")
    passkeys: bool = Field(description="Passkeys work under this address")
    screen: bool = Field(
        description="This is the robot's own screen and nobody owns the robot: it may show the "
        "invitation of the first owner"
    )


class PairingRequest(Wire):
    """The secret of an invitation: what follows #pair= in its address."""

    secret: Secret


class IssuedInvitation(Wire):
    """An invitation, shown once."""

    address: str = Field(description="To be opened once by whoever is invited")
    qr: str = Field(description="The address as a QR code: a data URI of an SVG picture")
    reachable: bool = Field(description="Other devices can open the address")
    expires_at: Timestamp


class InvitationRequest(Wire):
    """Whom to invite."""

    name: Name
    role: Role
    valid_minutes: int = Field(15, ge=1, le=7 * 24 * 60)
    ends_at: Timestamp | None = Field(None, description="When the person's rights end")


class InvitationEntry(Wire):
    """An invitation that was not used yet; its secret is not kept."""

    id: str
    name: str
    role: Role
    created_by: str
    created_at: Timestamp
    expires_at: Timestamp
    ends_at: Timestamp | None


class InvitationList(Wire):
    """Invitations that can still be used."""

    items: list[InvitationEntry]
    next_cursor: NextCursor


class DeviceEntry(Wire):
    """A paired browser."""

    id: str
    name: str
    created_at: Timestamp
    last_used_at: Timestamp
    last_from: str = Field(description="Network address")


class PersonEntry(PersonSummary):
    """A person with devices."""

    created_at: Timestamp
    devices: list[DeviceEntry]
    passkeys: int


class PersonList(Wire):
    """Everybody who is paired."""

    items: list[PersonEntry]
    next_cursor: NextCursor


class PersonSettings(Wire):
    """What somebody is."""

    name: Name
    role: Role
    ends_at: Timestamp | None = None


class KeyRequest(Wire):
    """A key to make."""

    name: Name
    scopes: list[Scope] = Field(min_length=1, max_length=len(Scope))


class KeyEntry(Wire):
    """A key; the key itself is not kept."""

    id: str
    name: str
    hint: str = Field(description="How the key ends")
    scopes: list[Scope]
    created_by: str
    created_at: Timestamp
    last_used_at: Timestamp | None
    last_from: str | None


class IssuedKey(KeyEntry):
    """A new key, shown once."""

    key: str = Field(description="Send it as `Authorization: Bearer KEY`")


class KeyList(Wire):
    """All keys."""

    items: list[KeyEntry]
    next_cursor: NextCursor


class PasskeyOptions(Wire):
    """Options for the browser's credentials API, as JSON of WebAuthn level 3."""

    options: dict[str, Any]


class PasskeyAnswer(Wire):
    """What the browser's credentials API made, as JSON of WebAuthn level 3."""

    credential: dict[str, Any]


class PasskeyEntry(Wire):
    """A passkey."""

    id: str
    name: str
    created_at: Timestamp
    last_used_at: Timestamp | None


class PasskeyList(Wire):
    """One's own passkeys."""

    items: list[PasskeyEntry]
    next_cursor: NextCursor


class AuditRecord(Wire):
    """One entry of the audit trail."""

    sequence: int
    at: Timestamp
    event: str
    actor: str
    address: str
    detail: dict[str, Any]
    times: int = Field(description="How often; repetitions of a burst are one entry")
    chain: str = Field(description="SHA-256 over this entry and the chain of the one before")


class AuditPage(Wire):
    """Entries, newest first."""

    items: list[AuditRecord]
    next_cursor: NextCursor
