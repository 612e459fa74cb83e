"""What the terminal says when the server is ready, and where others find a running server."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

import segno

from server.access.addresses import is_loopback, pairing_address, reachable_host
from server.storage.errors import DataFolderError

ADDRESS_FILE = "address"
JOURNAL = "JOURNAL_STREAM"
FOR_THE_JOURNAL = "Nobody owns the robot yet. Run `plugpilot pair` on this machine."


def page_address(scheme: str, listens_on: str, port: int) -> str:
    """Where a browser finds the home page, from other devices if that is possible at all."""
    return f"{scheme}://{reachable_host(listens_on)}:{port}"


def print_invitation(page: str, secret: str, out: TextIO) -> None:
    """Show a one-time address, and as a QR code where a person is looking.

    Into the system's journal, which others can read, no secret is written.

    Args:
        page: Where the home page is.
        secret: Of the invitation.
        out: Where to print.
    """
    if goes_to_journal(out):
        print(FOR_THE_JOURNAL, file=out, flush=True)
        return
    address = pairing_address(page, secret)
    print(f"Pair your browser, once: {address}", file=out, flush=True)
    host = page.split("://", 1)[1].rsplit(":", 1)[0].strip("[]")
    if is_loopback(host):
        if out.isatty():
            print("To use a phone, start with --host 0.0.0.0.", file=out, flush=True)
    elif out.isatty():
        print("Or scan this with your phone:", file=out)
        segno.make(address, error="l").terminal(out, compact=True)
        out.flush()


def print_root(page: str, fingerprint: str, out: TextIO) -> None:
    """Say where phones get the root certificate, and how to know that it is the right one."""
    print(f"Install on each phone, once: {page}/root.crt", file=out)
    print(f"Its SHA-256 is {fingerprint}", file=out, flush=True)


def goes_to_journal(out: TextIO) -> bool:
    """Whether systemd's journal keeps what is printed (systemd.exec(5), JOURNAL_STREAM)."""
    try:
        status = os.fstat(out.fileno())
    except (OSError, ValueError):
        return False
    return os.environ.get(JOURNAL) == f"{status.st_dev}:{status.st_ino}"


@contextlib.contextmanager
def findable(folder: Path, page: str) -> Iterator[None]:
    """Leave the address of the running server in the data folder, for the command line."""
    file = folder / ADDRESS_FILE
    try:
        file.write_text(f"{page}\n", encoding="ascii")
    except OSError as error:
        raise DataFolderError(f"{file} cannot be written: {error.strerror}.") from error
    try:
        yield
    finally:
        file.unlink(missing_ok=True)


def address_of_running(folder: Path) -> str | None:
    """Where the server of a data folder is; None when none runs."""
    try:
        return (folder / ADDRESS_FILE).read_text(encoding="ascii").strip() or None
    except OSError:
        return None
