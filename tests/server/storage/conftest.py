from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.postgres import PACKAGE, PostgresServer, programs, running_postgres


@pytest.fixture(scope="package")
def postgres() -> Iterator[PostgresServer]:
    """A PostgreSQL server; tests that stop it start it again."""
    bin_folder = programs()
    if bin_folder is None:
        pytest.skip(f"needs the Debian package {PACKAGE}")
    with running_postgres(bin_folder) as server:
        yield server
