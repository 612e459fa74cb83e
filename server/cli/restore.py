"""`plugpilot restore`: a backup in the place of the database."""

from __future__ import annotations

import asyncio
from pathlib import Path

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--with-people",
    is_flag=True,
    help="Take people, devices and keys from FILE, too. Whoever was removed since is back.",
)
@installation_options
def restore(settings: Settings, file: Path, *, with_people: bool) -> None:
    """Put the backup FILE in the place of the database. Stop PlugPilot first.

    What was there before is kept under another name. Where the plug is does not come from the
    backup: PlugPilot keeps that in a file of its own, and asks a person if it is lost. Nor does it
    say who may do what: that stays as it is now, and if it cannot be read any more everybody must
    be paired anew.
    """
    # imported late: --help and wrong settings should not wait for the database to load
    from server.storage.backups import BEFORE_RESTORE, FOLDER, stamp  # noqa: PLC0415
    from server.storage.exporting import export  # noqa: PLC0415
    from server.storage.folder_lock import holding  # noqa: PLC0415
    from server.storage.postgres_home import PostgresHome  # noqa: PLC0415
    from server.storage.restoring import restore as put_back  # noqa: PLC0415
    from server.storage.restoring import restore_to_server  # noqa: PLC0415

    folder, url = settings.storage.data_dir, settings.storage.url
    with holding(folder):
        if url is None:
            aside = put_back(file, folder, with_people=with_people)
        else:
            home = PostgresHome(url.get_secret_value())
            home.prepare()
            backups = folder / FOLDER
            backups.mkdir(mode=0o700, exist_ok=True)
            aside = backups / f"{BEFORE_RESTORE}{stamp()}.sqlite3"
            export(home, aside)
            restore_to_server(file, home, with_people=with_people)
    click.echo(f"Restored {file}.")
    if aside is not None:
        click.echo(f"What was there before is in {aside}.")
    if not asyncio.run(_note(settings, file, with_people=with_people)):
        click.echo("Nobody owns the robot now: the next start prints how to pair a browser.")


async def _note(settings: Settings, file: Path, *, with_people: bool) -> bool:
    """Put it into the audit trail; returns whether somebody owns the robot."""
    from server.access.audit import ACCESS_CHANGED  # noqa: PLC0415 - as above
    from server.access.pairing import MACHINE  # noqa: PLC0415 - as above
    from server.access.recovery import opened  # noqa: PLC0415 - as above

    async with opened(settings.storage, settings.access) as access:
        access.audit.record(
            ACCESS_CHANGED,
            actor=MACHINE,
            address="",
            operation="restore",
            backup=file.name,
            with_people=with_people,
        )
        return access.register.has_owner
