"""`plugpilot config`: the settings in force."""

from __future__ import annotations

from pathlib import Path

import click

from server.config import load_configuration
from server.config.listing import as_toml


@click.command()
@click.option("--config", "file", type=click.Path(path_type=Path), help="Configuration file.")
def config(file: Path | None) -> None:
    """Print the settings in force as TOML, with the origin of each that is no default.

    The output is a valid configuration file: `plugpilot config > plugpilot.toml` is a start.
    """
    click.echo(as_toml(load_configuration(file)), nl=False)
