"""Sessions, keys and roles: what is kept of them, and that they end."""

from __future__ import annotations

import sqlite3
from datetime import timedelta
from pathlib import Path

import pytest

from server.access import Need, Role, Scope
from server.access.errors import InvitationError, LastOwnerError, NoSuchEntryError
from server.access.rights import NO_RIGHTS, ROLE_RIGHTS
from server.api.gate.caller import COOKIE
from server.api.gate.watch import UNPAIRED
from server.storage.sqlite_home import FILE_NAME
from tests.support.front_door import FrontDoor
from tests.support.garage import Scene, on_scene
from tests.support.pairing import new_device, new_key

PHONE = "Mozilla/5.0 (Linux; Android 14) AppleWebKit/537.36 Chrome/130.0.0.0 Mobile Safari/537.36"


def test_no_secret_is_kept_in_the_data_folder(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> list[str]:
        access = scene.services.access
        invitation = await access.pairing.invite_owner(address="")
        _, device, cookie = await access.pairing.pair(invitation, PHONE, "192.0.2.7")
        assert device.name == "Chrome on Android"
        key = await new_key(access, Scope.READ)
        access.register.caller(key, "192.0.2.8")
        await access.audit.written()
        return [invitation, cookie, key]

    secrets = on_scene(scenario, folder=tmp_path, parked=False)
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert any(path.name == FILE_NAME for path in files)
    for path in files:
        content = path.read_bytes()
        for secret in secrets:
            assert secret.encode() not in content, path


def test_a_device_stays_paired_over_a_restart_with_its_last_use(tmp_path: Path) -> None:
    async def before(scene: Scene) -> str:
        cookie = await new_device(scene.services.access, Role.RESIDENT)
        scene.services.access.register.caller(cookie, "192.0.2.99")
        return cookie

    cookie = on_scene(before, folder=tmp_path, parked=False)

    async def after(scene: Scene) -> None:
        register = scene.services.access.register
        (device,) = register.devices.values()
        assert device.last_from == "192.0.2.99"
        caller = register.caller(cookie, "192.0.2.7")
        assert caller is not None
        assert caller.rights == ROLE_RIGHTS[Role.RESIDENT]
        assert cookie not in repr(register.devices)

    on_scene(after, folder=tmp_path, parked=False)


def test_a_technicians_rights_end_by_themselves() -> None:
    async def scenario(scene: Scene) -> None:
        access = scene.services.access
        ends_at = scene.services.calendar.now() + timedelta(seconds=60)
        invitation, secret = await access.pairing.invite(
            name="Tom",
            role=Role.TECHNICIAN,
            created_by="a test",
            address="",
            ends_at=ends_at,
        )
        assert invitation.ends_at == ends_at
        _, _, cookie = await access.pairing.pair(secret, PHONE, "192.0.2.7")
        caller = access.register.caller(cookie, "192.0.2.7")
        assert caller is not None
        assert caller.may(Need.SERVICE)
        await scene.later(61)
        assert access.register.rights_now(caller) == NO_RIGHTS
        late = access.register.caller(cookie, "192.0.2.7")
        assert late is not None
        assert late.rights == NO_RIGHTS

    on_scene(scenario, parked=False)


def test_a_device_that_was_not_used_for_long_is_out() -> None:
    async def scenario(scene: Scene) -> None:
        access = scene.services.access
        cookie = await new_device(access)
        (device,) = access.register.devices.values()
        access.register._unused = timedelta(seconds=30)
        assert access.register.caller(cookie, "") is not None
        await scene.later(31)
        assert access.register.caller(cookie, "") is None
        assert device.id in access.register.devices

    on_scene(scenario, parked=False)


def test_what_is_removed_is_out_at_once_also_where_it_watches() -> None:
    async def scenario(scene: Scene) -> None:
        access, door = scene.services.access, FrontDoor(scene.services)
        cookie = await new_device(access, Role.VIEWER)
        await new_device(access, Role.OWNER)
        headers = {"Cookie": f"{COOKIE}={cookie}"}
        said: list[int] = []

        async def watch(_scope: object, receive: object, send: object) -> None:
            await send({"type": "websocket.accept"})  # type: ignore[operator]
            await send({"type": "websocket.send", "text": "1"})  # type: ignore[operator]
            (device,) = [d for d in access.register.devices.values() if d.name == "Test"][:1]
            await access.register.remove_device(device.id)
            await send({"type": "websocket.send", "text": "2"})  # type: ignore[operator]
            said.append((await receive())["code"])  # type: ignore[operator]

        door._gate._app = watch
        sent = await door.open_socket("/api/v1/ws", headers)
        assert [message["type"] for message in sent] == [
            "websocket.accept",
            "websocket.send",
            "websocket.close",
        ]
        assert sent[-1]["code"] == UNPAIRED == said[0]

    on_scene(scenario, parked=False)


def test_the_last_owner_stays_one() -> None:
    async def scenario(scene: Scene) -> None:
        register = scene.services.access.register
        await new_device(scene.services.access, Role.OWNER)
        (owner,) = register.people.values()
        with pytest.raises(LastOwnerError):
            await register.remove_person(owner.id)
        with pytest.raises(LastOwnerError):
            await register.change_person(owner.id, name="X", role=Role.VIEWER, ends_at=None)
        with pytest.raises(LastOwnerError):
            await register.change_person(
                owner.id, name="X", role=Role.OWNER, ends_at=scene.services.calendar.now()
            )
        await new_device(scene.services.access, Role.OWNER)
        await register.remove_person(owner.id)
        assert len(register.devices) == len(register._by_digest) == 1
        with pytest.raises(NoSuchEntryError):
            await register.remove_person(owner.id)

    on_scene(scenario, parked=False)


def test_an_invitation_of_somebody_who_was_removed_is_void() -> None:
    async def scenario(scene: Scene) -> None:
        access = scene.services.access
        await new_device(access, Role.VIEWER)
        (person,) = access.register.people.values()
        _, secret = await access.pairing.invite(
            name=person.name,
            role=person.role,
            created_by="person: Viewer",
            address="",
            person_id=person.id,
        )
        await access.register.remove_person(person.id)
        with pytest.raises(InvitationError):
            await access.pairing.pair(secret, PHONE, "")

    on_scene(scenario, parked=False)


def test_a_revoked_key_and_nonsense_open_nothing() -> None:
    async def scenario(scene: Scene) -> None:
        register = scene.services.access.register
        secret = await new_key(scene.services.access, Scope.OPERATE, Scope.READ)
        caller = register.caller(secret, "")
        assert caller is not None
        assert caller.may(Need.STOP)
        await register.revoke_key(caller.id)
        assert register.rights_now(caller) == NO_RIGHTS
        for nonsense in (secret, "", "x" * 100_000, "\ud800", "plugpilot_"):
            assert register.caller(nonsense, "") is None

    on_scene(scenario, parked=False)


def test_the_database_file_keeps_to_itself(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    on_scene(lambda scene: scene.later(0), folder=folder, parked=False)
    assert folder.stat().st_mode & 0o077 == 0
    with sqlite3.connect(folder / FILE_NAME) as database:
        (count,) = database.execute("SELECT count(*) FROM people").fetchone()
    database.close()
    assert count == 0
