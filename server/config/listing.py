"""The settings in force as a TOML file that could be read again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import tomlkit
from tomlkit.container import Container
from tomlkit.items import Table

from server.config.loading import Configuration


def as_toml(configuration: Configuration) -> str:
    """Write all settings; those that are no defaults say where they were set."""
    document = tomlkit.document()
    values = configuration.settings.model_dump(mode="json")
    _fill(document, values, "", configuration.origins)
    return tomlkit.dumps(document)


def _fill(
    table: Container | Table, values: Mapping[str, Any], above: str, origins: Mapping[str, str]
) -> None:
    for name, value in values.items():
        key = f"{above}{name}"
        if isinstance(value, dict):
            inner = tomlkit.table()
            _fill(inner, value, f"{key}.", origins)
            table.add(name, inner)
            continue
        if value is None:
            continue  # TOML has no word for it; leaving the key out means the same
        item = tomlkit.item(value)
        if key in origins:
            item.comment(f"from {origins[key]}")
        table.add(name, item)
