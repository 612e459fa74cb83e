"""The newest lines of the log, kept in memory for whoever looks for the cause of something."""

from __future__ import annotations

import logging
from collections import deque

KEPT = 1500
MOST_CHARACTERS = 2000


class RecentLog(logging.Handler):
    """Keeps what passes the root logger; each line is cut off where it gets long."""

    def __init__(self) -> None:
        super().__init__()
        self.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
        self._lines: deque[str] = deque(maxlen=KEPT)

    @property
    def lines(self) -> list[str]:
        """Oldest first."""
        return list(self._lines)

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a line."""
        self._lines.append(self.format(record)[:MOST_CHARACTERS])

    def start(self) -> None:
        """Hear everything from now on."""
        logging.getLogger().addHandler(self)

    def stop(self) -> None:
        """Hear nothing more."""
        logging.getLogger().removeHandler(self)
