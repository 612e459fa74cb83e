"""`plugpilot restore`: a backup in the place of the database."""

from __future__ import annotations

from pathlib import Path

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@installation_options
def restore(settings: Settings, file: Path) -> None:
    """Put the backup FILE in the place of the database. Stop PlugPilot first.

    What was there before is kept under another name. Where the plug is does not come from the
    backup: PlugPilot keeps that in a file of its own, and asks a person if it is lost.
    """
    from server.storage.backups import BEFORE_RESTORE, FOLDER, stamp  # noqa: PLC0415
    from server.storage.exporting import export  # noqa: PLC0415
    from server.storage.folder_lock import holding  # noqa: PLC0415
    from server.storage.postgres_home import PostgresHome  # noqa: PLC0415
    from server.storage.restoring import restore as put_back  # noqa: PLC0415
    from server.storage.restoring import restore_to_server  # noqa: PLC0415

    folder, url = settings.storage.data_dir, settings.storage.url
    with holding(folder):
        if url is None:
            aside = put_back(file, folder)
        else:
            home = PostgresHome(url.get_secret_value())
            home.prepare()
            backups = folder / FOLDER
            backups.mkdir(mode=0o700, exist_ok=True)
            aside = backups / f"{BEFORE_RESTORE}{stamp()}.sqlite3"
            export(home, aside)
            restore_to_server(file, home)
    click.echo(f"Restored {file}.")
    if aside is not None:
        click.echo(f"What was there before is in {aside}.")
