"""Real disks that are full, limited or write-protected, each in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from server.control.model import PlugState
from server.control.plug_guard import PlugRecord
from server.storage.plug import StoredPlug
from tests.server.storage.samples import healthy, opened
from tests.support.virtual import run_virtual

PROJECT = Path(__file__).parents[3]
SCENARIO = [sys.executable, "-m", "tests.server.storage.small_disk"]
TIMEOUT_S = 60.0


def facts(*command: object) -> dict[str, object]:
    """What a scenario has seen."""
    run = subprocess.run(
        [str(part) for part in command],
        cwd=PROJECT,
        env={**os.environ, "PYTHONPATH": str(PROJECT), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    found: dict[str, object] = json.loads(run.stdout)
    return found


def namespaces() -> list[str] | None:
    """How to run a command that may mount; None where nobody lets us."""
    for how in (["unshare", "--mount"], ["unshare", "--map-root-user", "--mount"]):
        tried = subprocess.run(
            [*how, "mount", "-t", "tmpfs", "tmpfs", "/mnt"], capture_output=True, check=False
        )
        if tried.returncode == 0:
            return how
    return None


def test_a_full_disk_loses_neither_the_plug_nor_the_journal(tmp_path: Path) -> None:
    how = namespaces()
    if how is None:
        pytest.skip("needs the right to mount a small disk")
    script = 'mount -t tmpfs -o size=600k tmpfs "$0" && exec "$@" "$0"/data "$0"/filler'
    seen = facts(*how, "sh", "-c", script, tmp_path, *SCENARIO, "full")
    assert seen == {
        "code": "disk_full",
        "refused": "disk_full",
        "plug_on_full_disk": "free",
        "caught_up": True,
        "events_kept": True,
        "unplug_kept": True,
        "plug": "free",
    }


def test_a_file_that_must_not_grow_is_an_error_of_the_disk(tmp_path: Path) -> None:
    assert facts(*SCENARIO, "limited", tmp_path) == {
        "code": "disk_error",
        "refused": "disk_error",
        "unplug_kept": True,
        "plug": "free",
    }


def test_a_write_protected_disk_can_still_be_read(tmp_path: Path) -> None:
    how = namespaces()
    if how is None:
        pytest.skip("needs the right to mount a small disk")
    healthy(tmp_path / "data")

    async def plug_in() -> None:
        database = await opened(tmp_path / "data")
        await StoredPlug(database, tmp_path / "data").save(PlugRecord(PlugState.INSERTED, None))
        await database.close()

    run_virtual(plug_in())
    (tmp_path / "disk").mkdir()
    script = (
        'mount -t tmpfs tmpfs "$0"/disk && cp -r "$0"/data "$0"/disk && '
        'mount -o remount,ro "$0"/disk && exec "$@" "$0"/disk/data'
    )
    assert facts(*how, "sh", "-c", script, tmp_path, *SCENARIO, "read_only") == {
        "code": "disk_read_only",
        "refused": "disk_read_only",
        "can_be_read": True,
        "plug": "inserted",
    }
