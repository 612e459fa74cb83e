from __future__ import annotations

import pytest

from tests.rig.matrix.cell import HEADING, Row

ROWS = pytest.StashKey[list[Row]]()


@pytest.fixture(scope="session")
def table(request: pytest.FixtureRequest) -> list[Row]:
    """Rows to be shown at the end."""
    return request.config.stash.setdefault(ROWS, [])


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    """Show the table."""
    rows = config.stash.get(ROWS, [])
    if rows:
        terminalreporter.section("faults and what became of them")
        for line in (HEADING, *(row.line() for row in rows)):
            terminalreporter.write_line(line)
