"""`plugpilot audit`: the audit trail, written out or checked."""

from __future__ import annotations

import asyncio
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import click

from server.config import Option, load_settings

if TYPE_CHECKING:
    from server.access.audit import AuditEntry


@click.command()
@click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
@click.option("--data-dir", help="Folder of database and recordings.  [storage.data_dir, ./data]")
@click.option("--check", is_flag=True, help="Verify the chain instead of writing the trail out.")
@click.option(
    "--file",
    type=click.File(encoding="utf-8"),
    help="With --check: an exported trail, in place of that of the data folder.",
)
def audit(*, config: Path | None, data_dir: str | None, check: bool, file: TextIO | None) -> None:
    """Write out who did what, from where: one JSON object a line, oldest first.

    Each entry holds a digest over itself and the one before. --check finds entries that were
    changed, removed or put in between; it ends with status 1 if there are any.
    """
    from server.access.audit import AuditEntry, broken_links  # noqa: PLC0415 - loads the database

    if file is not None:
        entries = [AuditEntry.from_json(json.loads(line)) for line in file]
    else:
        settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
        entries = asyncio.run(_entries(settings.storage.data_dir))
    if not check:
        for entry in entries:
            click.echo(json.dumps(entry.as_json(), separators=(",", ":")))
        return
    broken = list(broken_links(iter(entries)))
    if broken:
        numbers = ", ".join(map(str, broken))
        click.echo(f"The trail was tampered with, at or before entry {numbers}.", err=True)
        sys.exit(1)
    click.echo(f"{len(entries)} entries, the chain is whole.")


async def _entries(folder: Path) -> list[AuditEntry]:
    from server.access.recovery import opened  # noqa: PLC0415 - as above
    from server.config.access import AccessSettings  # noqa: PLC0415

    async with opened(folder, AccessSettings()) as access:
        return [entry async for entry in access.audit.everything()]
