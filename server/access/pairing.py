"""Invitations: one-time addresses that make a browser somebody's."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable
from datetime import datetime, timedelta

from server.access.audit import AuditLog
from server.access.errors import InvitationError, NoSuchEntryError
from server.access.model import Device, Invitation, Person
from server.access.register import Register, new_id
from server.access.rights import Role
from server.access.store import AccessStore
from server.access.tokens import LONGEST, digest, new_invitation

MACHINE = "the machine itself"
FIRST_OWNER = "Owner"
FIRST_VALID = timedelta(days=1)
VALID = timedelta(minutes=15)

FRAGMENT = "#pair="
"""Behind the page's address. What follows a # never leaves the browser by itself: it is in no log,
in no referrer, and a preview of the link does not use it up."""


class Pairing:
    """Makes invitations and takes them, each once.

    Args:
        store: Where invitations are kept. The command line puts some there, too.
        register: Everybody who is known.
        audit: Is told of everything.
        now: The date.
    """

    def __init__(
        self,
        store: AccessStore,
        register: Register,
        audit: AuditLog,
        now: Callable[[], datetime],
    ) -> None:
        self._store = store
        self._register = register
        self._audit = audit
        self._now = now

    async def invite(
        self,
        *,
        name: str,
        role: Role,
        created_by: str,
        address: str,
        valid: timedelta = VALID,
        ends_at: datetime | None = None,
        person_id: str | None = None,
    ) -> tuple[Invitation, str]:
        """Make an invitation; the second value is its secret, known to nobody afterwards.

        Args:
            name: Of the person who will be paired.
            role: Of that person.
            created_by: Who invites.
            address: From where.
            valid: How long it can be used.
            ends_at: When the person's rights end.
            person_id: Of a known person who adds another device.
        """
        now, secret = self._now(), new_invitation()
        invitation = Invitation(
            id=new_id(),
            name=name,
            role=role,
            created_by=created_by,
            created_at=now,
            expires_at=now + valid,
            ends_at=ends_at,
            person_id=person_id,
        )
        await self._store.add_invitation(invitation, digest(secret))
        self._audit.record(
            "invitation.created",
            actor=created_by,
            address=address,
            invitation=invitation.id,
            name=name,
            role=role.value,
        )
        return invitation, secret

    async def invite_owner(self, *, address: str, valid: timedelta = FIRST_VALID) -> str:
        """The secret of an invitation that makes a browser an owner's.

        For whoever holds the machine in hand: the terminal it was started from, its own screen,
        its command line. Only the newest of these is valid.
        """
        await self._store.withdraw_all(MACHINE)
        _, secret = await self.invite(
            name=FIRST_OWNER, role=Role.OWNER, created_by=MACHINE, address=address, valid=valid
        )
        return secret

    async def pair(self, secret: str, user_agent: str, address: str) -> tuple[Person, Device, str]:
        """Use an invitation.

        Returns:
            The person, the new device, and what belongs into its cookie.

        Raises:
            InvitationError: not valid; the same for every reason.
        """
        invitation = None
        if len(secret) <= LONGEST:
            invitation = await self._store.use_invitation(digest(secret), self._now())
        person = None if invitation is None else await self._invited(invitation)
        if invitation is None or person is None:
            self._audit.record_burst("pairing.refused", actor="unknown", address=address)
            raise InvitationError("It was used before, it has expired, or it never existed.")
        device, cookie = await self._register.add_device(person, device_name(user_agent), address)
        self._audit.record(
            "pairing.done",
            actor=f"person: {person.name}",
            address=address,
            invitation=invitation.id,
            role=person.role.value,
            device=device.name,
            device_id=device.id,
        )
        return person, device, cookie

    async def open_invitations(self) -> list[Invitation]:
        """Those that can still be used."""
        now = self._now()
        return [each for each in await self._store.invitations() if each.is_open(now)]

    async def withdraw(self, invitation_id: str, *, by: str, address: str) -> None:
        """Make an invitation void.

        Raises:
            NoSuchEntryError: there is none that could still be used.
        """
        invitation = await self._store.withdraw_invitation(invitation_id)
        if invitation is None:
            raise NoSuchEntryError(f"There is no invitation {invitation_id[:64]}.")
        self._audit.record(
            "invitation.withdrawn", actor=by, address=address, invitation=invitation_id
        )

    async def _invited(self, invitation: Invitation) -> Person | None:
        if invitation.person_id is None:
            return await self._register.add_person(
                invitation.name, invitation.role, invitation.ends_at
            )
        return self._register.people.get(invitation.person_id)


_BROWSERS = (
    ("Edg/", "Edge"),
    ("OPR/", "Opera"),
    ("SamsungBrowser/", "Samsung Internet"),
    ("Firefox/", "Firefox"),
    ("FxiOS/", "Firefox"),
    ("CriOS/", "Chrome"),
    ("Chrome/", "Chrome"),
    ("Safari/", "Safari"),
)
_SYSTEMS = (
    ("iPhone", "iPhone"),
    ("iPad", "iPad"),
    ("Android", "Android"),
    ("Windows", "Windows"),
    ("Macintosh", "Mac"),
    ("CrOS", "Chromebook"),
    ("Linux", "Linux"),
)


def device_name(user_agent: str) -> str:
    """What a person calls a browser, such as "Chrome on Android"."""
    browser = next((name for mark, name in _BROWSERS if mark in user_agent), None)
    system = next((name for mark, name in _SYSTEMS if mark in user_agent), None)
    if browser is not None and system is not None:
        return f"{browser} on {system}"
    plain = "".join(c for c in user_agent if unicodedata.category(c)[0] in "LNPSZ")
    return system or browser or plain[:60].strip() or "A program"
