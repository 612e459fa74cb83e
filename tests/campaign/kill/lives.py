"""Starts servers on a garage, and reads from their database what a dead one had written."""

from __future__ import annotations

import contextlib
import os
import sqlite3
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import httpx

from tests.support.process import READY, ServerProcess

START_S = 120.0
PROJECT = Path(__file__).parents[3]
DATABASE = "plugpilot.sqlite3"


class ServerDiedError(Exception):
    """The server ended before it was ready, or while it was asked something."""


@dataclass(frozen=True, slots=True)
class Life:
    """One run of the server.

    Attributes:
        process: It.
        client: Of its API.
        launched_at: Wall clock [s since 1970].
        ready_at: The same for its line.
    """

    process: subprocess.Popen[str]
    client: httpx.Client
    launched_at: float
    ready_at: float


@dataclass(frozen=True, slots=True)
class Written:
    """What the database says about the newest job.

    Attributes:
        phase: Of the job.
        state: Of the job.
        events: (kind, phase, wall clock) of its journal.
        plug: Where the plug is.
    """

    phase: str
    state: str
    events: list[tuple[str, str, float]]
    plug: str


def launch(socket: Path, folder: Path, speed: float) -> subprocess.Popen[str]:
    """Start a server; it needs seconds until it is ready."""
    command = [
        *(sys.executable, "-m", "tests.campaign.kill.server", str(socket), "serve", "--port=0"),
        *(f"--data-dir={folder}", f"--speed={speed}"),
    ]
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PLUGPILOT_")}
    return subprocess.Popen(
        command,
        cwd=folder.parent,
        env=environment | {"PYTHONPATH": str(PROJECT), "PLUGPILOT_LOGGING__LEVEL": "error"},
        stdout=subprocess.PIPE,
        text=True,
        bufsize=1,
    )


@contextlib.contextmanager
def alive(process: subprocess.Popen[str], launched_at: float, folder: Path) -> Iterator[Life]:
    """Wait until a server is ready, and see to it that it has ended afterwards.

    The client is an owner's who is paired anew, as a person would be whose phone is not known.

    Raises:
        ServerDiedError: it has not come so far.
    """
    overdue = threading.Timer(START_S, process.kill)
    overdue.start()
    assert process.stdout is not None
    try:
        line = process.stdout.readline()
        overdue.cancel()
        if not line.startswith(READY):
            raise ServerDiedError
        ready_at = time.time()
        url = line.removeprefix(READY).strip()
        server = ServerProcess(process, url, ready_at - launched_at, folder)
        with server.rest(timeout_s=60.0) as client:
            yield Life(process, client, launched_at, ready_at)
    except httpx.TransportError as error:
        raise ServerDiedError from error
    finally:
        overdue.cancel()
        process.kill()
        process.wait()
        process.stdout.close()


def written(folder: Path) -> Written | None:
    """What a dead server had written; None when no job was accepted."""
    with contextlib.closing(sqlite3.connect(folder / DATABASE)) as database:
        tables = {name for (name,) in database.execute("SELECT name FROM sqlite_master")}
        if "jobs" not in tables:
            return None
        job = database.execute("SELECT id, phase, state FROM jobs ORDER BY id DESC").fetchone()
        if job is None:
            return None
        events = database.execute(
            "SELECT kind, phase, strftime('%s', at) + strftime('%f', at) % 1 FROM job_events "
            "WHERE job_id = ? ORDER BY sequence",
            (job[0],),
        ).fetchall()
        plug = database.execute("SELECT state FROM plug").fetchone()
    return Written(job[1], job[2], events, plug[0] if plug else "")
