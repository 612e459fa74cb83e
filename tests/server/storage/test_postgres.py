"""The same data on a PostgreSQL server."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import psycopg
import pytest
from pydantic import SecretStr
from sqlalchemy import text

from server.access import Access, Role
from server.access.audit import AuditLog, broken_links
from server.access.errors import InvitationError
from server.access.recovery import invite_owner
from server.access.recovery import opened as access_of
from server.config.access import AccessSettings
from server.config.storage import StorageSettings
from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugRecord
from server.jobs.model import JobPhase, JobState, JobType
from server.labels.payload import LabelKey
from server.schema.vehicles import SocketOffset, VehicleSettings
from server.storage.database import RETRY_S, Database
from server.storage.errors import (
    DatabaseUnreachableError,
    DatabaseVersionError,
    StorageError,
)
from server.storage.exporting import export
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.postgres_home import PostgresHome
from server.storage.restoring import restore_to_server
from server.storage.upgrade import HEAD
from server.storage.vehicles import VehicleStore
from server.timing import Calendar
from tests.server.storage.first_release import INTERRUPTED, first_release
from tests.server.storage.samples import event, job
from tests.server.storage.test_upgrade import differences
from tests.support.pairing import new_device
from tests.support.postgres import PostgresServer
from tests.support.virtual import run_virtual, wait_until

INSERTED = PlugRecord(PlugState.INSERTED, Corridor(241.5, 212.3, 61.8, 81.8, 121.8))


async def opened(folder: Path, url: str) -> Database:
    database = Database(folder, url=url)
    await database.open()
    return database


def test_the_steps_make_what_the_models_say(postgres: PostgresServer) -> None:
    home = PostgresHome(postgres.new_database())
    home.prepare()
    home.prepare()
    with home.engine.connect() as connection:
        assert differences(connection) == []
    home.engine.dispose()


def test_everything_comes_back_as_it_was(postgres: PostgresServer, tmp_path: Path) -> None:
    url = postgres.new_database()

    async def scenario() -> None:
        database = await opened(tmp_path, url)
        assert database.problem is None
        jobs = JobStore(database)
        await jobs.add(job(1), key="key", digest="digest")
        await jobs.save(job(1), event(1, "Grüße"))
        with pytest.raises(StorageError, match="duplicate"):
            await jobs.add(job(2), key="key", digest="digest")
        assert await jobs.get(job(2).id) is None
        await StoredPlug(database, tmp_path).save(INSERTED)
        offset = SocketOffset(x_mm=1.0, y_mm=2.0, z_mm=3.0, rotation_x_rad=0.0, rotation_y_rad=0.0)
        settings = VehicleSettings(name="Zoé", label_size_mm=60.0, socket=offset)
        await VehicleStore(database, LabelKey(bytes(32))).put("zoe", settings)
        assert not (tmp_path / "plugpilot.sqlite3").exists()
        await database.close()

        database = await opened(tmp_path, url)
        jobs = JobStore(database)
        assert await jobs.by_key("key") == (job(1), "digest")
        assert await jobs.events(job(1).id) == [event(1, "Grüße")]
        assert [found.id for found in await jobs.unfinished()] == [job(1).id]
        assert await StoredPlug(database).load() == INSERTED
        vehicle = await VehicleStore(database, LabelKey(bytes(32))).get("zoe")
        assert vehicle is not None
        assert vehicle.name == "Zoé"
        await database.close()

    run_virtual(scenario())


@pytest.mark.parametrize("statement", ["UPDATE audit SET actor = 'Eve'", "DELETE FROM audit"])
def test_the_audit_trail_refuses_changes(
    postgres: PostgresServer, tmp_path: Path, statement: str
) -> None:
    url = postgres.new_database()

    async def scenario() -> None:
        database = await opened(tmp_path, url)
        log = AuditLog(database, Calendar().now)
        log.record("operation", actor="person: Zoé", address="192.0.2.7", name="Grüße")
        await log.written()
        with pytest.raises(StorageError, match="append-only"):
            await database.run(lambda session: session.execute(text(statement)))
        entries = [entry async for entry in log.everything()]
        assert [entry.detail for entry in entries] == [{"name": "Grüße"}]
        assert list(broken_links(iter(entries))) == []
        await log.close()
        await database.close()

    run_virtual(scenario())


def test_the_command_line_invites_into_the_database_of_the_server(
    postgres: PostgresServer, tmp_path: Path
) -> None:
    storage = StorageSettings(data_dir=tmp_path, url=SecretStr(postgres.new_database()))

    async def scenario() -> None:
        secret = await invite_owner(storage, AccessSettings())
        async with access_of(storage, AccessSettings()) as access:
            person, _, _ = await access.pairing.pair(secret, "Firefox/140 Linux", "192.0.2.7")
            assert person.role is Role.OWNER
            with pytest.raises(InvitationError):
                await access.pairing.pair(secret, "Firefox/140 Linux", "192.0.2.7")
        async with access_of(storage, AccessSettings()) as access:
            assert access.register.has_owner
        assert not (tmp_path / "plugpilot.sqlite3").exists()

    run_virtual(scenario())


def test_a_server_that_goes_and_comes_back(postgres: PostgresServer, tmp_path: Path) -> None:
    url = postgres.new_database()

    async def scenario() -> None:
        database = await opened(tmp_path, url)
        jobs = JobStore(database)
        await jobs.add(job(1), key=None, digest=None)
        charging = job(1).model_copy(update={"phase": JobPhase.CHARGING})
        await jobs.save(charging, event(1))
        postgres.stop()
        releasing = job(1).model_copy(update={"phase": JobPhase.RELEASING})
        await jobs.save(releasing, event(2))
        assert isinstance(database.problem, DatabaseUnreachableError)
        with pytest.raises(DatabaseUnreachableError):
            await jobs.add(job(2), key=None, digest=None)
        unplug = job(3).model_copy(update={"type": JobType.UNPLUG})
        await jobs.add(unplug, key=None, digest=None)
        assert await jobs.get(releasing.id) == releasing
        postgres.start()
        await wait_until(lambda: database.problem is None, timeout_s=3 * RETRY_S)
        assert [found.sequence for found in await jobs.events(job(1).id)] == [1, 2]
        assert await jobs.get(unplug.id) == unplug
        await database.close()

    run_virtual(scenario())


def test_who_is_known_is_known_again_when_the_server_comes_back(
    postgres: PostgresServer, tmp_path: Path
) -> None:
    url = postgres.new_database()

    async def scenario() -> None:
        database = await opened(tmp_path, url)
        access = Access(database, Calendar(), AccessSettings())
        await access.start()
        cookie = await new_device(access)
        await access.close()
        await database.close()

        postgres.stop()
        database = await opened(tmp_path, url)
        access = Access(database, Calendar(), AccessSettings())
        await access.start()
        assert access.register.caller(cookie, "192.0.2.7") is None
        postgres.start()
        await wait_until(lambda: database.problem is None, timeout_s=3 * RETRY_S)
        await wait_until(lambda: access.register.has_owner)
        assert access.register.caller(cookie, "192.0.2.7") is not None
        await access.close()
        await database.close()

    run_virtual(scenario())


def test_a_server_that_is_not_there_does_not_keep_the_robot_from_starting(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path, f"postgresql://nobody@/none?host={tmp_path}")
        assert isinstance(database.problem, DatabaseUnreachableError)
        plug = await StoredPlug(database, tmp_path).load()
        assert plug is not None
        assert plug.state is PlugState.UNKNOWN
        await database.close()

    run_virtual(scenario())


def test_the_password_is_in_no_sentence() -> None:
    home = PostgresHome("postgresql://robot:secret@127.0.0.1:1/none")
    with pytest.raises(DatabaseUnreachableError) as raised:
        home.prepare()
    assert "secret" not in f"{raised.value.detail}{raised.value.context}"
    assert "secret" not in home.name


def test_a_newer_schema_is_refused(postgres: PostgresServer, tmp_path: Path) -> None:
    url = postgres.new_database()
    home = PostgresHome(url)
    home.prepare()
    home.engine.dispose()
    newer = int(HEAD) + 1
    with psycopg.connect(url) as connection:
        connection.execute("UPDATE alembic_version SET version_num = %s", [f"{newer:04}"])

    async def scenario() -> None:
        await opened(tmp_path, url)

    with pytest.raises(DatabaseVersionError, match=f"has version {newer}"):
        run_virtual(scenario())


def test_a_backup_moves_from_file_to_server_and_back(
    postgres: PostgresServer, tmp_path: Path
) -> None:
    file = first_release(tmp_path / "old")
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")
        before = connection.execute("SELECT * FROM vehicles ORDER BY id").fetchall()
    url = postgres.new_database()
    home = PostgresHome(url)
    restore_to_server(file, home)
    with psycopg.connect(url) as server:
        server.execute("INSERT INTO audit VALUES (1, now(), 'e', 'a', '', '{}', 1, '')")
        server.execute("INSERT INTO people VALUES ('1', 'Anna', 'owner', now(), NULL)")
        server.execute("INSERT INTO vehicles VALUES ('newer', '{}')")
    # What was there is replaced, but for who may do what and the trail, which cannot be changed.
    restore_to_server(file, home)
    exported = tmp_path / "exported.sqlite3"
    export(home, exported)
    home.engine.dispose()
    with closing(sqlite3.connect(exported)) as connection:
        assert connection.execute("SELECT * FROM vehicles ORDER BY id").fetchall() == before
        states = dict(connection.execute("SELECT id, state FROM jobs").fetchall())
        (events,) = connection.execute("SELECT count(*) FROM job_events").fetchone()
        assert connection.execute("SELECT state FROM plug").fetchall() == [("unknown",)]
        assert connection.execute("SELECT event FROM audit").fetchall() == [("e",)]
        assert connection.execute("SELECT name FROM people").fetchall() == [("Anna",)]
    assert states[INTERRUPTED] == JobState.FAILED
    assert events == 35
