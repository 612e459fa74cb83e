"""`plugpilot backup`: a copy of the data, made while PlugPilot runs."""

from __future__ import annotations

from pathlib import Path

import click

from server.cli.storage_options import installation_options
from server.config.settings import Settings


@click.command()
@click.argument("file", type=click.Path(path_type=Path))
@installation_options
def backup(settings: Settings, file: Path) -> None:
    """Copy jobs, vehicles and webhooks into FILE, which must not exist yet.

    PlugPilot may go on meanwhile: the copy is one moment of its data, and is read again before
    FILE gets its name. Recordings are files of their own beside the database and are not in it.
    Put it back with `plugpilot restore FILE`.
    """
    from server.storage.backups import back_up  # noqa: PLC0415 - quick --help
    from server.storage.exporting import export  # noqa: PLC0415
    from server.storage.postgres_home import PostgresHome  # noqa: PLC0415
    from server.storage.sqlite_home import FILE_NAME  # noqa: PLC0415

    url = settings.storage.url
    if url is None:
        back_up(settings.storage.data_dir / FILE_NAME, file)
    else:
        export(PostgresHome(url.get_secret_value()), file)
    click.echo(
        f"Made {file} ({file.stat().st_size / 1024:.0f} kB), and read it again: it is whole."
    )
