"""`plugpilot pair`: an invitation for an owner, for whoever holds the machine in hand."""

from __future__ import annotations

import asyncio
import sys

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings


@click.command()
@installation_options
def pair(settings: Settings) -> None:
    """Print a one-time address and a QR code that make a browser or phone an owner's.

    It can be used for a quarter of an hour. That is also the way back in when every paired device
    is lost: remove those under "People" afterwards.
    """
    # imported late: --help and wrong settings should not wait for the database to load
    from server.access.recovery import invite_owner  # noqa: PLC0415
    from server.announcement import (  # noqa: PLC0415
        address_of_running,
        page_address,
        print_invitation,
    )

    page = address_of_running(settings.storage.data_dir)
    if page is None:
        click.echo("PlugPilot does not run with this data folder; start it first.", err=True)
        page = page_address("http", settings.server.host, settings.server.port)
    secret = asyncio.run(invite_owner(settings.storage, settings.access))
    print_invitation(page, secret, sys.stdout)
