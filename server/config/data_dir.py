"""The folder that keeps what PlugPilot must not forget."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from server.config.errors import DataDirError


def prepare_data_dir(data_dir: Path) -> Path:
    """Make the folder if it is missing, readable by its owner only, and check it by writing.

    A folder that exists keeps its permissions: who made it may share it on purpose.

    Returns:
        The absolute path.

    Raises:
        DataDirError: it cannot be made, is no folder, or cannot be written.
    """
    path = data_dir.expanduser().absolute()
    try:
        path.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path):
            pass
    except OSError as error:
        reason = os.strerror(error.errno) if error.errno else str(error)
        msg = f"The data folder {path} cannot be written ({reason})."
        raise DataDirError(msg, path=str(path)) from error
    return path
