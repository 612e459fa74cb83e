"""Everybody who is known, in memory: who knocks is recognised without asking the database."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime, timedelta
from typing import TypeVar

from uuid6 import uuid7

from server.access.errors import LastOwnerError, NoSuchEntryError
from server.access.model import ApiKey, Caller, Device, Passkey, Person
from server.access.rights import NO_RIGHTS, Rights, Role, Scope
from server.access.store import AccessStore, Entry
from server.access.tokens import LONGEST, digest, new_key, new_session
from server.errors import PlugPilotError

_log = logging.getLogger(__name__)

T = TypeVar("T")

SEEN_EVERY_S = 60.0
HINT_CHARACTERS = 4


def new_id() -> str:
    """An id for a new entry; ids sort by age."""
    return str(uuid7())


class Register:
    """People, their devices and passkeys, and keys.

    What changes is on disk before it is in force; the last use of a device or key is written a
    little later.

    Args:
        store: Where they are kept.
        now: The date.
        unused: A device that was not used for so long is forgotten.
        seen_every_s: How often last uses are written [s of the event loop].
    """

    def __init__(
        self,
        store: AccessStore,
        now: Callable[[], datetime],
        unused: timedelta,
        seen_every_s: float = SEEN_EVERY_S,
    ) -> None:
        self._store = store
        self._now = now
        self._unused = unused
        self._seen_every_s = seen_every_s
        self.people: dict[str, Person] = {}
        self.devices: dict[str, Device] = {}
        self.keys: dict[str, ApiKey] = {}
        self.passkeys: dict[str, Passkey] = {}
        self._by_digest: dict[str, str] = {}
        self._seen: set[str] = set()
        self._writing: asyncio.Task[None] | None = None

    async def load(self) -> None:
        """Read everybody from the database."""
        people, devices, keys, passkeys = await self._store.everything()
        self.people = {person.id: person for person in people}
        self.devices = {device.id: device for device in devices}
        self.keys = {key.id: key for key in keys}
        self.passkeys = {passkey.id: passkey for passkey in passkeys}
        self._by_digest = {device.digest: device.id for device in devices}
        self._by_digest |= {key.digest: key.id for key in keys}

    async def close(self) -> None:
        """Write what was not written yet."""
        if self._writing is not None:
            self._writing.cancel()
            await asyncio.gather(self._writing, return_exceptions=True)
        await self._write_seen()

    @property
    def has_owner(self) -> bool:
        """Whether somebody owns the robot."""
        return any(person.role is Role.OWNER for person in self.people.values())

    def caller(self, secret: str, address: str) -> Caller | None:
        """Whose session or key this is; None when it is nobody's."""
        if len(secret) > LONGEST:
            return None
        entry_id = self._by_digest.get(digest(secret), "")
        now = self._now()
        device, key = self.devices.get(entry_id), self.keys.get(entry_id)
        if device is not None and now - device.last_used_at < self._unused:
            self.devices[device.id] = replace(device, last_used_at=now, last_from=address)
            self._seen_now(device.id)
            person = self.people[device.person_id]
            return Caller("person", device.id, person.name, person.rights(now), address, person)
        if key is not None:
            self.keys[key.id] = replace(key, last_used_at=now, last_from=address)
            self._seen_now(key.id)
            return Caller("key", key.id, key.name, key.rights, address)
        return None

    def rights_now(self, caller: Caller) -> Rights:
        """What somebody may do now who was let in before: rights end, devices are removed."""
        match caller.kind:
            case "person":
                device = self.devices.get(caller.id)
                if device is None:
                    return NO_RIGHTS
                return self.people[device.person_id].rights(self._now())
            case "key":
                key = self.keys.get(caller.id)
                return NO_RIGHTS if key is None else key.rights
            case _:
                return caller.rights

    def person(self, person_id: str) -> Person:
        """A person.

        Raises:
            NoSuchEntryError: nobody has this id.
        """
        return _found(self.people, person_id, "person")

    async def add_person(self, name: str, role: Role, ends_at: datetime | None) -> Person:
        """Make somebody known."""
        person = Person(new_id(), name, role, self._now(), ends_at)
        await self._store.put(person)
        self.people[person.id] = person
        return person

    async def change_person(
        self, person_id: str, *, name: str, role: Role, ends_at: datetime | None
    ) -> Person:
        """Change what somebody is.

        Raises:
            NoSuchEntryError: nobody has this id.
            LastOwnerError: there would be no owner any more.
        """
        old = self.person(person_id)
        person = replace(old, name=name, role=role, ends_at=ends_at)
        if person.role is not Role.OWNER or person.ends_at is not None:
            self._refuse_to_lose_owner(person_id)
        await self._store.put(person)
        self.people[person.id] = person
        return person

    async def remove_person(self, person_id: str) -> Person:
        """Forget somebody, with devices and passkeys.

        Raises:
            NoSuchEntryError: nobody has this id.
            LastOwnerError: there would be no owner any more.
        """
        person = self.person(person_id)
        self._refuse_to_lose_owner(person_id)
        await self._store.remove(person)
        for device in [d for d in self.devices.values() if d.person_id == person_id]:
            self._forget(device)
        for passkey in [p for p in self.passkeys.values() if p.person_id == person_id]:
            del self.passkeys[passkey.id]
        del self.people[person_id]
        return person

    async def add_device(self, person: Person, name: str, address: str) -> tuple[Device, str]:
        """Make a browser somebody's; the second value belongs into its cookie and nowhere else."""
        secret, now = new_session(), self._now()
        device = Device(new_id(), person.id, name, digest(secret), now, now, address)
        await self._store.put(device)
        self.devices[device.id] = device
        self._by_digest[device.digest] = device.id
        return device, secret

    async def remove_device(self, device_id: str) -> Device:
        """Forget a browser: it is out at once.

        Raises:
            NoSuchEntryError: there is no such device.
        """
        device = _found(self.devices, device_id, "device")
        await self._store.remove(device)
        self._forget(device)
        return device

    async def add_key(
        self, name: str, scopes: tuple[Scope, ...], created_by: str
    ) -> tuple[ApiKey, str]:
        """Make a key; the second value is shown once."""
        secret = new_key()
        key = ApiKey(
            id=new_id(),
            name=name,
            hint=secret[-HINT_CHARACTERS:],
            digest=digest(secret),
            scopes=scopes,
            created_by=created_by,
            created_at=self._now(),
        )
        await self._store.put(key)
        self.keys[key.id] = key
        self._by_digest[key.digest] = key.id
        return key, secret

    async def revoke_key(self, key_id: str) -> ApiKey:
        """Forget a key: it is out at once.

        Raises:
            NoSuchEntryError: there is no such key.
        """
        key = _found(self.keys, key_id, "key")
        await self._store.remove(key)
        del self.keys[key.id]
        del self._by_digest[key.digest]
        return key

    async def put_passkey(self, passkey: Passkey) -> None:
        """Keep a passkey, new or used."""
        await self._store.put(passkey)
        self.passkeys[passkey.id] = passkey

    async def remove_passkey(self, passkey_id: str) -> Passkey:
        """Forget a passkey.

        Raises:
            NoSuchEntryError: there is no such passkey.
        """
        passkey = _found(self.passkeys, passkey_id, "passkey")
        await self._store.remove(passkey)
        del self.passkeys[passkey.id]
        return passkey

    def _forget(self, device: Device) -> None:
        del self.devices[device.id]
        del self._by_digest[device.digest]

    def _refuse_to_lose_owner(self, person_id: str) -> None:
        owners = [p for p in self.people.values() if p.role is Role.OWNER and p.ends_at is None]
        if [owner.id for owner in owners] == [person_id]:
            raise LastOwnerError(f"{owners[0].name} is the only owner.")

    def _seen_now(self, entry_id: str) -> None:
        self._seen.add(entry_id)
        if self._writing is None:
            self._writing = asyncio.get_running_loop().create_task(
                self._write_later(), name="last use of devices"
            )

    async def _write_later(self) -> None:
        await asyncio.sleep(self._seen_every_s)
        self._writing = None
        await self._write_seen()

    async def _write_seen(self) -> None:
        seen, self._seen = self._seen, set()
        entries: list[Entry] = [self.devices[i] for i in seen if i in self.devices]
        entries += [self.keys[i] for i in seen if i in self.keys]
        if not entries:
            return
        try:
            await self._store.put(*entries)
        except PlugPilotError as error:
            _log.warning("the last use of devices could not be written: %s", error)


def _found(entries: dict[str, T], entry_id: str, what: str) -> T:
    entry = entries.get(entry_id)
    if entry is None:
        raise NoSuchEntryError(f"There is no {what} {entry_id[:64]}.")
    return entry
