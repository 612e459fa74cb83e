"""`plugpilot pair`: an invitation for an owner, for whoever holds the machine in hand."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path

import click

from server.config import Option, load_settings


@click.command()
@click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
@click.option("--data-dir", help="Folder of database and recordings.  [storage.data_dir, ./data]")
def pair(*, config: Path | None, data_dir: str | None) -> None:
    """Print a one-time address and a QR code that make a browser or phone an owner's.

    It can be used for a quarter of an hour. That is also the way back in when every paired device
    is lost: remove those under "People" afterwards.
    """
    settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
    # imported late: --help and wrong settings should not wait for the database to load
    from server.access.recovery import invite_owner  # noqa: PLC0415
    from server.announcement import (  # noqa: PLC0415
        address_of_running,
        page_address,
        print_invitation,
    )

    folder = settings.storage.data_dir
    page = address_of_running(folder)
    if page is None:
        click.echo("PlugPilot does not run with this data folder; start it first.", err=True)
        page = page_address("http", settings.server.host, settings.server.port)
    secret = asyncio.run(invite_owner(folder, settings.access))
    print_invitation(page, secret, sys.stdout)
