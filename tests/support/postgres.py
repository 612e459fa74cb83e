"""A PostgreSQL server of the test's own: a cluster in a temporary folder, reached by a socket."""

from __future__ import annotations

import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import psycopg

PACKAGE = "postgresql"
USER = "postgres"
TIMEOUT_S = 60.0


def programs() -> Path | None:
    """The folder of initdb and pg_ctl; Debian keeps one for each version."""
    found = shutil.which("initdb")
    if found is not None:
        return Path(found).parent
    versions = Path("/usr/lib/postgresql").glob("*/bin/initdb")
    newest = max(versions, key=lambda path: float(path.parts[-3]), default=None)
    return newest.parent if newest is not None else None


class PostgresServer:
    """A running server.

    Args:
        folder: Of the cluster and its socket.
        bin_folder: Where its programs are.
    """

    def __init__(self, folder: Path, bin_folder: Path) -> None:
        self._folder = folder
        self._bin = bin_folder
        self._databases = 0

    def new_database(self) -> str:
        """The address of an empty database."""
        self._databases += 1
        name = f"test{self._databases}"
        with psycopg.connect(self._address("postgres"), autocommit=True) as connection:
            connection.execute(f"CREATE DATABASE {name}".encode())
        return self._address(name)

    def start(self) -> None:
        options = f"-c listen_addresses='' -c unix_socket_directories={self._folder} -c fsync=off"
        self._run("pg_ctl", "start", "--wait", "-s", "-l", str(self._folder / "log"), "-o", options)

    def stop(self) -> None:
        """At once, as a server that is switched off."""
        self._run("pg_ctl", "stop", "--wait", "-s", "--mode=immediate")

    def initialise(self) -> None:
        self._run("initdb", "--auth=trust", f"--username={USER}", "--no-sync", "-E", "UTF8")

    def _address(self, name: str) -> str:
        return f"postgresql://{USER}@/{name}?host={self._folder}"

    def _run(self, program: str, *arguments: str) -> None:
        # The server refuses to run as root.
        as_user = {"user": USER, "group": USER, "extra_groups": []} if os.geteuid() == 0 else {}
        subprocess.run(
            [self._bin / program, "--pgdata", self._folder / "data", *arguments],
            cwd=self._folder,
            check=True,
            timeout=TIMEOUT_S,
            stdout=subprocess.DEVNULL,
            **as_user,  # type: ignore[call-overload]  # three arguments that fit together
        )


@contextmanager
def running_postgres(bin_folder: Path) -> Iterator[PostgresServer]:
    """Run a server until the block ends."""
    # Not among pytest's folders, which other users cannot enter. A socket's path must be short.
    with tempfile.TemporaryDirectory(prefix="pg-") as name:
        folder = Path(name)
        if os.geteuid() == 0:
            user = pwd.getpwnam(USER)
            os.chown(folder, user.pw_uid, user.pw_gid)
        server = PostgresServer(folder, bin_folder)
        server.initialise()
        server.start()
        try:
            yield server
        finally:
            server.stop()
