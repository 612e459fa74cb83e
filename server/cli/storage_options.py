"""Which installation a command about its data means."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any

import click

from server.config import Option, load_settings


def installation_options(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options --config and --data-dir; it gets ``settings`` in their place."""

    @click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
    @click.option("--data-dir", help="Folder of the database.  [storage.data_dir, ./data]")
    @wraps(command)
    def with_settings(*, config: Path | None, data_dir: str | None, **others: Any) -> None:  # noqa: ANN401
        settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
        command(settings=settings, **others)

    return with_settings
