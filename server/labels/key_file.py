"""Where the key lives that signs labels: a small file in the data folder."""

from __future__ import annotations

import contextlib
import os
import secrets
import stat
from pathlib import Path

from server.labels.errors import LabelKeyError
from server.labels.payload import LabelKey

FILE_NAME = "label.key"
KEY_BYTES = 32
OWNER_ONLY = stat.S_IRUSR | stat.S_IWUSR


def load_label_key(folder: Path | None) -> LabelKey:
    """The key of an installation, made when there is none yet.

    Args:
        folder: The data folder; None gives a key that is forgotten with the process.

    Raises:
        LabelKeyError: the file cannot be used, or others can read it.
    """
    if folder is None:
        return LabelKey(secrets.token_bytes(KEY_BYTES))
    path = folder / FILE_NAME
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileExistsError):
            _make(path)
        if path.stat().st_mode & (stat.S_IRWXG | stat.S_IRWXO):
            raise LabelKeyError(f"Others can read {path}.")
        return LabelKey(_parse(path))
    except OSError as error:
        raise LabelKeyError(f"{path} cannot be read or made: {error.strerror}.") from error


def _make(path: Path) -> None:
    """Write a new key under its name at once or not at all, and never over an older one."""
    draft = path.with_name(f"{path.name}.{secrets.token_hex(4)}")
    descriptor = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY)
    try:
        with os.fdopen(descriptor, "w") as file:
            file.write(f"{secrets.token_hex(KEY_BYTES)}\n")
            file.flush()
            os.fsync(file.fileno())
        os.link(draft, path)
    finally:
        draft.unlink()


def _parse(path: Path) -> bytes:
    text = path.read_text(encoding="ascii", errors="replace").strip()
    try:
        secret = bytes.fromhex(text)
    except ValueError:
        secret = b""
    if len(secret) != KEY_BYTES:
        raise LabelKeyError(f"{path} does not hold {2 * KEY_BYTES} hexadecimal digits.")
    return secret
