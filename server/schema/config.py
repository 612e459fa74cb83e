"""The configuration as the API shows it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, JsonValue

from server.schema.base import Timestamp, Wire

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
        description="Sections that can be changed here; the others, and "
        "webhooks.allowed_networks, only in the configuration file"
    )
    settings: dict[str, Section] = Field(
        description="By section, as in the configuration file; secrets are hidden"
    )


class ConfigurationField(Wire):
    """One setting as a field of a form."""

    key: str = Field(description="Section and name, dotted", examples=["webhooks.timeout_s"])
    kind: Literal["number", "integer", "boolean", "text", "choice", "other"]
    words: str = Field(description="What it is for")
    optional: bool = Field(description="It may be left empty")
    choices: list[str]
    least: float | None
    most: float | None
    changeable: bool = Field(
        description="At once and without a restart; else in the configuration file, and PlugPilot "
        "must be started again"
    )


class ConfigurationFields(Wire):
    """All settings, section by section."""

    fields: list[ConfigurationField]


class ConfigurationTrouble(Wire):
    """What is wrong, and where."""

    key: str = Field(description="Of the field; empty if it is about no one field")
    sentence: str


class ConfigurationDifference(Wire):
    """One setting that would be another; secrets are hidden."""

    key: str
    before: JsonValue
    after: JsonValue


class ConfigurationCheck(Wire):
    """What a change would do. Nothing was changed."""

    troubles: list[ConfigurationTrouble]
    differences: list[ConfigurationDifference]


class ConfigurationVersion(Wire):
    """What was changed over the API since the start, after one change."""

    number: int = Field(ge=0, description="0 is what PlugPilot was started with")
    at: Timestamp | None
    by: str = Field(description="Who changed something")
    changes: dict[str, Section]


class ConfigurationHistory(Wire):
    """Versions to which one can go back, the newest first."""

    versions: list[ConfigurationVersion]
