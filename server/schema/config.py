"""The configuration as the API shows it."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, JsonValue

from server.schema.base import Wire

Section = dict[str, JsonValue]
Name = Annotated[str, Field(min_length=1, max_length=80)]
ConfigurationPatch = Annotated[
    dict[Name, Annotated[dict[Name, JsonValue], Field(max_length=50)]],
    Field(
        max_length=20,
        description="A JSON merge patch (RFC 7396): sections with the settings that are to change; "
        "null gives a setting the value back that PlugPilot was started with",
    ),
]


class Configuration(Wire):
    """All settings in force."""

    changeable: list[str] = Field(
        description="Sections that can be changed here; the others are in the configuration file"
    )
    settings: dict[str, Section] = Field(
        description="By section, as in the configuration file; secrets are hidden"
    )
