"""Where the plug is, in a tiny file of its own: it outlives a damaged database and a full disk.

Two records lie one behind the other and are written in turn, so that a power cut spoils at most the
one that was not yet in force. All room is taken when the file is made.
"""

from __future__ import annotations

import contextlib
import json
import os
import zlib
from dataclasses import asdict, dataclass
from pathlib import Path

from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugRecord

FILE_NAME = "plug.place"
SLOT_BYTES = 4096
SLOTS = 2
MARK = b"plug1 "
CRC_DIGITS = 8
OWNER_ONLY = 0o600


@dataclass(frozen=True, slots=True)
class NumberedRecord:
    """A record and its number, which grows with every change."""

    record: PlugRecord
    revision: int


class DamagedPlugFileError(Exception):
    """There is a file, and no record in it can be read."""


class PlugFile:
    """The file. All methods block.

    Args:
        folder: The data folder.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE_NAME

    def read(self) -> NumberedRecord | None:
        """The newest record, or None without a file.

        Raises:
            DamagedPlugFileError: neither record can be read.
            OSError: the file cannot be read.
        """
        try:
            content = self.path.read_bytes()
        except FileNotFoundError:
            return None
        slots = [content[i * SLOT_BYTES : (i + 1) * SLOT_BYTES] for i in range(SLOTS)]
        found = [numbered for slot in slots if (numbered := _parse(slot)) is not None]
        if not found:
            raise DamagedPlugFileError
        return max(found, key=lambda numbered: numbered.revision)

    def write(self, numbered: NumberedRecord) -> None:
        """Write a record down; returns when it is safe on disk.

        Raises:
            OSError: it cannot be written; the record before it is still there.
        """
        slot = _line(numbered).ljust(SLOT_BYTES, b" ")
        if not self.path.is_file():
            self._make(slot)
            return
        descriptor = os.open(self.path, os.O_WRONLY)
        try:
            os.lseek(descriptor, numbered.revision % SLOTS * SLOT_BYTES, os.SEEK_SET)
            _write_all(descriptor, slot)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)

    def _make(self, slot: bytes) -> None:
        """Give the file its name only when it is whole."""
        draft = self.path.with_name(f"{FILE_NAME}.part")
        descriptor = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, OWNER_ONLY)
        try:
            _write_all(descriptor, slot * SLOTS)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
        draft.replace(self.path)
        if os.name == "posix":  # elsewhere a folder cannot be opened, and need not be
            folder = os.open(self.path.parent, os.O_RDONLY)
            try:
                os.fsync(folder)
            finally:
                os.close(folder)


def _write_all(descriptor: int, content: bytes) -> None:
    while content:
        content = content[os.write(descriptor, content) :]


def _line(numbered: NumberedRecord) -> bytes:
    corridor = numbered.record.corridor
    text = json.dumps(
        {
            "revision": numbered.revision,
            "state": numbered.record.state.value,
            "corridor": asdict(corridor) if corridor else None,
        }
    ).encode()
    return MARK + b"%0*x %s\n" % (CRC_DIGITS, zlib.crc32(text), text)


def _parse(slot: bytes) -> NumberedRecord | None:
    line, end, _ = slot.partition(b"\n")
    crc, _, text = line.removeprefix(MARK).partition(b" ")
    if not end or not line.startswith(MARK) or crc != b"%0*x" % (CRC_DIGITS, zlib.crc32(text)):
        return None
    with contextlib.suppress(ValueError, TypeError, KeyError):  # written by another version
        values = json.loads(text)
        corridor = Corridor(**values["corridor"]) if values["corridor"] else None
        record = PlugRecord(PlugState(values["state"]), corridor)
        return NumberedRecord(record, int(values["revision"]))
    return None
