"""`plugpilot version`: what is installed."""

from __future__ import annotations

import click

from server.version import VERSION


@click.command()
def version() -> None:
    """Print the version."""
    click.echo(f"plugpilot {VERSION}")
