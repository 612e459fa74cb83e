"""`plugpilot audit`: the audit trail, written out or checked."""

from __future__ import annotations

import asyncio
import json
import sys
from typing import TYPE_CHECKING, TextIO

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings

if TYPE_CHECKING:
    from server.access.audit import AuditEntry


@click.command()
@installation_options
@click.option("--check", is_flag=True, help="Verify the chain instead of writing the trail out.")
@click.option(
    "--file",
    type=click.File(encoding="utf-8"),
    help="With --check: an exported trail, in place of that of the data folder.",
)
def audit(settings: Settings, *, check: bool, file: TextIO | None) -> None:
    """Write out who did what, from where: one JSON object a line, oldest first.

    Each entry holds a digest over itself and the one before. --check finds entries that were
    changed, removed or put in between; it ends with status 1 if there are any.
    """
    from server.access.audit import AuditEntry, broken_links  # noqa: PLC0415 - loads the database

    if file is not None:
        entries = [AuditEntry.from_json(json.loads(line)) for line in file]
    else:
        entries = asyncio.run(_entries(settings))
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


async def _entries(settings: Settings) -> list[AuditEntry]:
    from server.access.recovery import opened  # noqa: PLC0415 - as above

    async with opened(settings.storage, settings.access) as access:
        return [entry async for entry in access.audit.everything()]
