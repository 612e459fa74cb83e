"""Put the configuration together: options over environment over file over defaults."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from server.config.errors import InvalidSettingsError
from server.config.layers import (
    Entry,
    Key,
    Option,
    chosen_file,
    environment_entries,
    file_entries,
    option_entries,
)
from server.config.problems import describe
from server.config.settings import Settings

Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class Configuration:
    """The settings in force and where those that are not defaults came from.

    Attributes:
        settings: The checked settings.
        origins: For each key that was set, such as "server.port", where it was set last.
    """

    settings: Settings
    origins: Mapping[str, str]


def load_configuration(config: Path | None = None, options: Sequence[Option] = ()) -> Configuration:
    """Read all sources and check the result once.

    Args:
        config: The configuration file; None looks for PLUGPILOT_CONFIG, then ./plugpilot.toml.
        options: Options of the command line that stand for settings.

    Raises:
        ConfigurationFileError: the file cannot be read, or is not TOML.
        InvalidSettingsError: values or keys that cannot be; lists all of them.
    """
    file = chosen_file(config)
    entries = [
        *(file_entries(file) if file else []),
        *environment_entries(),
        *option_entries(options),
    ]
    settings = checked(Settings, entries)
    return Configuration(settings, {".".join(entry.key): entry.origin for entry in entries})


def load_settings(config: Path | None = None, options: Sequence[Option] = ()) -> Settings:
    """The settings alone; see `load_configuration`."""
    return load_configuration(config, options).settings


def checked(model: type[Model], entries: Sequence[Entry]) -> Model:
    """A model of its defaults with entries over them; later ones win.

    Raises:
        InvalidSettingsError: values or keys that cannot be; lists all of them.
    """
    # The defaults lie below, so that a file may set one number of a table and keep the others.
    values: dict[str, Any] = model().model_dump()
    for entry in entries:
        _put(values, entry.key, entry.value)
    try:
        return model(**values)
    except ValidationError as error:
        raise _invalid(error, entries) from error


def _put(values: dict[str, Any], key: Key, value: Any) -> None:  # noqa: ANN401 - not checked yet
    *tables, name = key
    for table in tables:
        inner = values.get(table)
        if not isinstance(inner, dict):
            inner = values[table] = {}
        values = inner
    if value == {} and isinstance(values.get(name), dict):
        return  # an empty table in the file changes nothing
    values[name] = value


def _invalid(error: ValidationError, entries: Sequence[Entry]) -> InvalidSettingsError:
    problems = [describe(problem, entries) for problem in error.errors()]
    count = "1 setting" if len(problems) == 1 else f"{len(problems)} settings"
    msg = f"{count} cannot be:\n" + "\n".join(f"  {problem}" for problem in problems)
    return InvalidSettingsError(msg, problems=problems)
