"""A backup brings nobody back: who may do what is as it is now."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest

from server.access import Access, Role, Scope
from server.access.audit import broken_links
from server.access.errors import InvitationError
from server.access.recovery import invite_owner
from server.access.recovery import opened as access_of
from server.config.access import AccessSettings
from server.config.storage import StorageSettings
from server.storage.backups import back_up
from server.storage.restoring import restore
from server.storage.sqlite_home import FILE_NAME
from tests.support.virtual import run_virtual


@pytest.mark.parametrize("with_people", [False, True])
def test_an_invitation_in_a_backup_lets_nobody_in_a_second_time(
    tmp_path: Path, *, with_people: bool
) -> None:
    storage, settings = StorageSettings(data_dir=tmp_path), AccessSettings()
    secret = run_virtual(invite_owner(storage, settings))
    backup = tmp_path / "backup"
    back_up(tmp_path / FILE_NAME, backup)

    async def pair() -> None:
        async with access_of(storage, settings) as access:
            await access.pairing.pair(secret, "", "")

    run_virtual(pair())
    restore(backup, tmp_path, with_people=with_people)
    with pytest.raises(InvitationError):
        run_virtual(pair())


async def _change(folder: Path, change: Callable[[Access], Awaitable[None]]) -> None:
    async with access_of(StorageSettings(data_dir=folder), AccessSettings()) as access:
        await change(access)


@pytest.mark.parametrize("with_people", [False, True])
def test_who_was_removed_since_the_backup_stays_out(tmp_path: Path, *, with_people: bool) -> None:
    secrets: dict[str, str] = {}

    async def then(access: Access) -> None:
        anna = await access.register.add_person("Anna", Role.OWNER, None)
        ben = await access.register.add_person("Ben", Role.TECHNICIAN, None)
        for who, person in (("anna", anna), ("ben", ben)):
            _, secrets[who] = await access.register.add_device(person, "Phone", "")
        _, secrets["key"] = await access.register.add_key("evcc", (Scope.OPERATE,), "Anna")
        access.audit.record("operation", actor="person: Ben", address="")

    async def since(access: Access) -> None:
        register = access.register
        (ben,) = [p.id for p in register.people.values() if p.name == "Ben"]
        await register.remove_person(ben)
        await register.revoke_key(next(iter(register.keys)))
        _, secrets["new"] = await register.add_device(
            next(iter(register.people.values())), "New phone", ""
        )
        access.audit.record("access", actor="person: Anna", address="")

    async def now(access: Access) -> None:
        known = {who for who, secret in secrets.items() if access.register.caller(secret, "")}
        assert known == ({"anna", "ben", "key"} if with_people else {"anna", "new"})
        trail = [entry async for entry in access.audit.everything()]
        assert len(trail) == (1 if with_people else 2)
        assert list(broken_links(iter(trail))) == []

    run_virtual(_change(tmp_path, then))
    backup = tmp_path / "backup"
    back_up(tmp_path / FILE_NAME, backup)
    run_virtual(_change(tmp_path, since))
    restore(backup, tmp_path, with_people=with_people)
    run_virtual(_change(tmp_path, now))


@pytest.mark.parametrize("damage", ["gone", "unreadable"])
def test_without_a_database_to_ask_a_backup_lets_nobody_in(tmp_path: Path, damage: str) -> None:
    async def then(access: Access) -> None:
        anna = await access.register.add_person("Anna", Role.OWNER, None)
        await access.register.add_device(anna, "Phone", "")
        access.audit.record("operation", actor="person: Anna", address="")

    async def now(access: Access) -> None:
        assert not access.register.people
        assert not access.register.devices
        assert len([entry async for entry in access.audit.everything()]) == 1

    run_virtual(_change(tmp_path, then))
    file, backup = tmp_path / FILE_NAME, tmp_path / "backup"
    back_up(file, backup)
    file.unlink()
    if damage == "unreadable":
        file.write_bytes(b"shopping list\n" * 1000)
    restore(backup, tmp_path)
    run_virtual(_change(tmp_path, now))
