"""`plugpilot backup`, `restore` and `database`."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from server.cli import main
from server.storage.folder_lock import holding
from server.storage.sqlite_home import FILE_NAME
from tests.server.storage.samples import healthy


@pytest.fixture
def data(clean_environment: Path) -> Path:
    """A data folder where the command looks for it by itself."""
    folder = clean_environment / "data"
    healthy(folder)
    return folder


def plugpilot(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


def jobs_in(file: Path) -> int:
    with closing(sqlite3.connect(file)) as connection:
        (count,) = connection.execute("SELECT count(*) FROM jobs").fetchone()
    return int(count)


def test_a_backup_is_made_and_restored(data: Path) -> None:
    run = plugpilot("backup", "safe")
    assert run.exit_code == 0
    assert "Made safe" in run.output
    assert jobs_in(Path("safe")) == 30
    (data / FILE_NAME).write_bytes(b"shopping list\n" * 1000)
    run = plugpilot("restore", "safe")
    assert run.exit_code == 0
    assert "Restored safe." in run.output
    assert "set-aside" in run.output
    assert "Nobody owns the robot now" in run.output
    assert jobs_in(data / FILE_NAME) == 30
    assert '"operation":"restore"' in plugpilot("audit").output


def test_a_backup_replaces_nothing(data: Path) -> None:
    del data
    Path("safe").write_text("mine")
    run = plugpilot("backup", "safe")
    assert run.exit_code == 2
    assert "there already" in run.output
    assert Path("safe").read_text() == "mine"


def test_a_running_plugpilot_is_not_restored_under_its_feet(data: Path) -> None:
    plugpilot("backup", "safe")
    before = (data / FILE_NAME).read_bytes()
    with holding(data):
        for command in (("restore", "safe"), ("database", "new")):
            run = plugpilot(*command)
            assert run.exit_code == 2
            assert "Stop the other one first" in run.output
    assert (data / FILE_NAME).read_bytes() == before


def test_a_database_is_checked_and_its_backups_listed(data: Path) -> None:
    (data / "backups").mkdir()
    plugpilot("backup", str(data / "backups" / "plugpilot-1.sqlite3"))
    run = plugpilot("database", "check")
    assert run.exit_code == 0
    assert "is whole" in run.output
    assert "plugpilot-1.sqlite3" in run.output
    file = data / FILE_NAME
    file.write_bytes(file.read_bytes()[:4096] + b"\x55" * 40_000)
    run = plugpilot("database", "check")
    assert run.exit_code == 2
    assert "plugpilot restore" in run.output
    assert "plugpilot-1.sqlite3" in run.output


def test_a_new_database_is_begun_at_the_next_start(data: Path) -> None:
    run = plugpilot("database", "new")
    assert run.exit_code == 0
    assert not (data / FILE_NAME).exists()
    (aside,) = data.glob("plugpilot-set-aside-*.sqlite3")
    assert str(aside.name) in run.output
    assert jobs_in(aside) == 30


@pytest.mark.parametrize("url", ["sqlite:///x", "nonsense", "postgresql://h:port/x"])
def test_an_address_that_is_none_is_told_without_its_password(
    data: Path, monkeypatch: pytest.MonkeyPatch, url: str
) -> None:
    del data
    monkeypatch.setenv("PLUGPILOT_STORAGE__URL", url)
    run = plugpilot("database", "check")
    assert run.exit_code == 2
    assert "storage.url" in run.output
    assert url not in run.output
