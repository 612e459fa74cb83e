"""Where data is kept."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field

from server.config.section import Section


class StorageSettings(Section):
    """The folder of the database and the recordings."""

    data_dir: Path = Field(
        Path("data"),
        description="Made when it is missing; relative to the folder PlugPilot is started in",
    )
