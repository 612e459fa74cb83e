"""Files that nobody but their owner may read."""

from __future__ import annotations

from pathlib import Path

from server.tls.errors import ExposedKeyError

OTHERS = 0o077


def require_private(path: Path) -> None:
    """Do nothing if only its owner can read a file.

    Raises:
        ExposedKeyError: others can, too.
        OSError: there is no such file.
    """
    if path.stat().st_mode & OTHERS:
        raise ExposedKeyError(f"Others than its owner can read {path}.")
