"""`plugpilot database`: look after the database."""

from __future__ import annotations

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings


@click.group()
def database() -> None:
    """Check the database, or begin a new one."""


@database.command()
@installation_options
def check(settings: Settings) -> None:
    """Read the whole database, also while PlugPilot runs, and list its backups."""
    from server.storage.backups import Backups, check_file  # noqa: PLC0415 - quick --help
    from server.storage.errors import BackupError  # noqa: PLC0415
    from server.storage.postgres_home import PostgresHome  # noqa: PLC0415
    from server.storage.sqlite_home import FILE_NAME  # noqa: PLC0415

    folder, url = settings.storage.data_dir, settings.storage.url
    if url is not None:
        home = PostgresHome(url.get_secret_value())
        home.prepare()
        click.echo(f"{home.name} answers. The server checks its files by itself.")
        return
    file = folder / FILE_NAME
    backups = Backups(folder, 0).all()
    for backup in reversed(backups):
        click.echo(f"backup {backup.path} of {backup.made_at:%Y-%m-%d %H:%M} UTC")
    if not file.is_file():
        raise BackupError(f"There is no database {file}.", file=str(file))
    check_file(file)
    click.echo(f"{file} is whole.")


@database.command()
@installation_options
def new(settings: Settings) -> None:
    """Set the database aside; the next start begins a new one. Stop PlugPilot first.

    Nothing is deleted. Vehicles have to be added again, or restored with `plugpilot restore`.
    """
    from server.config.errors import ConfigurationError  # noqa: PLC0415 - quick --help
    from server.storage.folder_lock import holding  # noqa: PLC0415
    from server.storage.restoring import begin_anew  # noqa: PLC0415

    if settings.storage.url is not None:
        raise ConfigurationError("storage.url names a server: make a new database there.")
    with holding(settings.storage.data_dir):
        aside = begin_anew(settings.storage.data_dir)
    click.echo("There was no database." if aside is None else f"The database is now {aside}.")
