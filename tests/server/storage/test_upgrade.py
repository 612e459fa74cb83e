"""Databases of earlier versions, and of later ones."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, text

from server.control.model import PlugState
from server.jobs.model import JobState
from server.labels.payload import LabelKey
from server.storage.backups import FOLDER as BACKUPS
from server.storage.database import Database
from server.storage.engines import file_engine
from server.storage.errors import DatabaseVersionError, StorageError
from server.storage.jobs import JobStore
from server.storage.models import MODULES, Base
from server.storage.plug import StoredPlug
from server.storage.sqlite_home import FILE_NAME
from server.storage.upgrade import HEAD, MIGRATIONS, needs_upgrade, upgrade
from server.storage.vehicles import VehicleStore
from tests.server.storage.first_release import (
    CANCELLED,
    EVENTS,
    INTERRUPTED,
    SUCCEEDED,
    first_release,
)
from tests.support.virtual import run_virtual


def differences(connection: Connection) -> list[object]:
    """Between what the steps have made and what the models say."""
    context = MigrationContext.configure(
        connection, opts={"compare_type": True, "compare_server_default": True}
    )
    return list(compare_metadata(context, Base.metadata))


def open_and_close(folder: Path) -> None:
    async def scenario() -> None:
        database = Database(folder)
        await database.open()
        assert database.problem is None
        await database.close()

    run_virtual(scenario())


def backups(folder: Path) -> list[Path]:
    return sorted((folder / BACKUPS).glob("*"))


def test_the_steps_make_what_the_models_say(tmp_path: Path) -> None:
    engine = file_engine(tmp_path / "new.sqlite3")
    with engine.begin() as connection:
        assert needs_upgrade(connection, "new")
        upgrade(connection)
        assert not needs_upgrade(connection, "new")
        assert differences(connection) == []
        connection.execute(text("ALTER TABLE jobs DROP COLUMN paused"))
        assert differences(connection), "the comparison sees a missing column"
    engine.dispose()


def test_the_newest_step_is_known_without_alembic() -> None:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    assert ScriptDirectory.from_config(config).get_heads() == [HEAD]


def test_a_database_of_the_first_release_becomes_one_of_today(tmp_path: Path) -> None:
    file = first_release(tmp_path)

    async def scenario() -> None:
        database = Database(tmp_path)
        await database.open()
        assert database.problem is None
        jobs = JobStore(database)
        found = await jobs.page(before=None, limit=10)
        assert [(job.id, job.state) for job in found] == [
            (INTERRUPTED, JobState.RUNNING),
            (CANCELLED, JobState.CANCELLED),
            (SUCCEEDED, JobState.SUCCEEDED),
        ]
        assert [job.id for job in await jobs.unfinished()] == [INTERRUPTED]
        assert found[2].result.insertion_depth_mm == pytest.approx(40, abs=1)
        assert sum([len(await jobs.events(job.id)) for job in found]) == EVENTS
        assert await jobs.by_key("key-1") == (found[2], "0" * 64)
        vehicles = await VehicleStore(database, LabelKey(bytes(32))).all()
        assert [vehicle.id for vehicle in vehicles] == ["demo", "zoe"]
        plug = await StoredPlug(database, tmp_path).load()
        assert plug is not None
        assert plug.state is PlugState.INSERTED
        assert plug.corridor is not None
        assert plug.corridor.depth_rho3_mm > plug.corridor.clear_rho3_mm > 0
        await database.close()

    run_virtual(scenario())
    with closing(sqlite3.connect(file)) as connection:
        assert connection.execute("PRAGMA user_version").fetchone() == (int(HEAD),)
    engine = file_engine(file)
    with engine.connect() as compared:
        assert differences(compared) == []
    engine.dispose()


def test_a_copy_is_made_before_the_schema_changes_and_only_then(tmp_path: Path) -> None:
    file = first_release(tmp_path)
    with closing(sqlite3.connect(file)) as connection:
        before = list(connection.iterdump())
    open_and_close(tmp_path)
    (backup,) = backups(tmp_path)
    assert backup.name.startswith("before-upgrade-")
    with closing(sqlite3.connect(backup)) as connection:
        assert list(connection.iterdump()) == before
        assert connection.execute("PRAGMA user_version").fetchone() == (1,)
    open_and_close(tmp_path)
    assert backups(tmp_path) == [backup]


def test_a_new_database_needs_no_copy(tmp_path: Path) -> None:
    open_and_close(tmp_path)
    open_and_close(tmp_path)
    assert backups(tmp_path) == []


def test_an_upgrade_that_fails_changes_nothing(tmp_path: Path) -> None:
    file = first_release(tmp_path)
    with closing(sqlite3.connect(file)) as connection:
        # a step will not find what it expects
        connection.execute("CREATE TABLE changed_settings (id INTEGER)")
        before = list(connection.iterdump())

    async def scenario() -> None:
        await Database(tmp_path).open()

    with pytest.raises(StorageError, match="changed_settings"):
        run_virtual(scenario())
    with closing(sqlite3.connect(file)) as connection:
        assert list(connection.iterdump()) == before
        assert connection.execute("PRAGMA user_version").fetchone() == (1,)


@pytest.mark.parametrize("how", ["number", "step"])
def test_the_database_of_a_newer_version_is_refused_and_left_alone(
    tmp_path: Path, how: str
) -> None:
    open_and_close(tmp_path)
    newer = int(HEAD) + 1
    with closing(sqlite3.connect(tmp_path / FILE_NAME)) as connection:
        if how == "number":
            connection.execute(f"PRAGMA user_version = {newer}")
        else:
            connection.execute("UPDATE alembic_version SET version_num = ?", [f"{newer:04}"])
            connection.commit()

    async def scenario() -> None:
        await Database(tmp_path).open()

    with pytest.raises(DatabaseVersionError) as raised:
        run_virtual(scenario())
    assert raised.value.context["version"] == newer
    assert f"has version {newer}; this PlugPilot reads version {int(HEAD)}" in raised.value.detail


def test_every_module_with_tables_is_compared() -> None:
    defined_in = {mapper.class_.__module__ for mapper in Base.registry.mappers}
    assert {module.__name__ for module in MODULES} == defined_in
