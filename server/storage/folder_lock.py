"""Only one PlugPilot at a time uses a data folder."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from server.storage.errors import DataFolderError, FolderInUseError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_log = logging.getLogger(__name__)

FILE_NAME = "plugpilot.lock"
OWNER_ONLY = 0o600


@contextlib.contextmanager
def holding(folder: Path) -> Iterator[None]:
    """Own a data folder until the block ends, or the process, however it does.

    Raises:
        DataFolderError: the folder cannot be made.
        FolderInUseError: another process owns it.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as error:
        raise DataFolderError(
            f"{folder} cannot be made: {error.strerror}.", folder=str(folder)
        ) from error
    descriptor = _open(folder / FILE_NAME)
    if descriptor is None:
        yield
        return
    try:
        _lock(descriptor, folder)
        yield
    finally:
        os.close(descriptor)


def _open(path: Path) -> int | None:
    for flags in (os.O_RDWR | os.O_CREAT, os.O_RDONLY):
        with contextlib.suppress(OSError):
            return os.open(path, flags, OWNER_ONLY)
    # A disk that has become write-protected must not keep the robot from starting.
    _log.warning("%s cannot be made; nothing keeps a second PlugPilot away", path)
    return None


def _lock(descriptor: int, folder: Path) -> None:
    try:
        if sys.platform == "win32":
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        raise FolderInUseError(f"Another PlugPilot uses {folder}.", folder=str(folder)) from error
