"""Which robot `plugpilot workspace` looks at: a geometry file, or the settings in force."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from pydantic import BaseModel, ConfigDict, Field

from server.config import ConfigurationError, load_settings
from server.config.layers import file_entries
from server.config.loading import checked
from server.config.settings import Settings
from twin.geometry import RobotGeometry
from twin.statics import ActuatorLimits, Loads


class NoGeometryError(ConfigurationError):
    """The file has no section [geometry]."""

    code: ClassVar[str] = "geometry_missing"
    title: ClassVar[str] = "The file describes no robot"
    remedy: ClassVar[str] = "Start from the section [geometry] that `plugpilot config` prints."


class Design(BaseModel):
    """The sections that describe a robot as a machine."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    geometry: RobotGeometry = Field(default_factory=RobotGeometry)
    loads: Loads = Field(default_factory=Loads)
    actuators: ActuatorLimits = Field(default_factory=ActuatorLimits)


def load_design(file: Path | None) -> Design:
    """Read a robot; what the file leaves out has its default.

    A whole plugpilot.toml will do: sections that describe no machine are passed over, so that a
    robot can be studied whose park position, say, is not chosen yet.

    Args:
        file: TOML with [geometry] and, if they differ, [loads] and [actuators]; None takes the
            settings in force.

    Raises:
        ConfigurationFileError: the file cannot be read, or is not TOML.
        NoGeometryError: it has no section [geometry].
        InvalidSettingsError: values or keys that cannot be; lists all of them.
    """
    if file is None:
        settings = load_settings()
        return Design(
            geometry=settings.geometry, loads=settings.loads, actuators=settings.actuators
        )
    others = set(Settings.model_fields) - set(Design.model_fields)
    entries = [entry for entry in file_entries(file) if entry.key[0] not in others]
    design = checked(Design, entries)
    if not any(entry.key[0] == "geometry" for entry in entries):
        msg = f"The file {file} has no section [geometry]."
        raise NoGeometryError(msg, path=str(file))
    return design
