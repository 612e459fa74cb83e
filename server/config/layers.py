"""Where settings come from: the file, the environment, the options of the command."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic_settings import EnvSettingsSource
from pydantic_settings.exceptions import SettingsError

from server.config.errors import ConfigurationFileError, InvalidSettingsError
from server.config.settings import Settings

ENV_PREFIX = "PLUGPILOT_"
ENV_DELIMITER = "__"
CONFIG_VARIABLE = "PLUGPILOT_CONFIG"
DEFAULT_FILE = Path("plugpilot.toml")

Key = tuple[str, ...]
"""Path of a setting: ("server", "port") is written server.port."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One value that somebody set.

    Attributes:
        key: Path of the setting.
        value: As it was given, not checked yet.
        origin: Where it came from, in words that complete "in ...".
    """

    key: Key
    value: Any
    origin: str


@dataclass(frozen=True, slots=True)
class Option:
    """An option of the command line that stands for a setting; a value of None was not given."""

    flag: str
    key: str
    value: Any


def file_entries(path: Path) -> list[Entry]:
    """Read a configuration file.

    Raises:
        ConfigurationFileError: it cannot be read, or is not TOML; names line and column.
    """
    try:
        values = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        msg = f"The configuration file {path} cannot be read ({error.strerror})."
        raise ConfigurationFileError(msg, path=str(path)) from error
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        msg = f"The configuration file {path} is not UTF-8 text (line {line})."
        raise ConfigurationFileError(msg, path=str(path)) from error
    except tomllib.TOMLDecodeError as error:
        msg = f"The configuration file {path} is not valid TOML: {error}."
        raise ConfigurationFileError(msg, path=str(path)) from error
    return [Entry(key, value, str(path)) for key, value in leaves(values)]


def chosen_file(config: Path | None) -> Path | None:
    """The file to read: the one named, else that of PLUGPILOT_CONFIG, else ./plugpilot.toml."""
    if config is not None:
        return config
    if named := os.environ.get(CONFIG_VARIABLE):
        return Path(named)
    return DEFAULT_FILE if DEFAULT_FILE.exists() else None


def environment_entries() -> list[Entry]:
    """Read variables such as PLUGPILOT_SERVER__PORT; tables may be given as JSON.

    Raises:
        InvalidSettingsError: a variable for a table holds no JSON.
    """
    try:
        values = EnvSettingsSource(Settings)()
    except SettingsError as error:
        names = ", ".join(name for name in sorted(os.environ) if _is_setting(name))
        msg = f"A whole table in an environment variable must be JSON; look at {names}."
        raise InvalidSettingsError(msg) from error
    entries = [Entry(key, value, _variable_of(key)) for key, value in leaves(values)]
    return entries + list(_unknown_sections())


def option_entries(options: Sequence[Option]) -> list[Entry]:
    """Take the options that were given."""
    return [
        Entry(tuple(option.key.split(".")), option.value, f"option {option.flag}")
        for option in options
        if option.value is not None
    ]


def leaves(values: Mapping[str, Any], above: Key = ()) -> Iterator[tuple[Key, Any]]:
    """All values of nested tables with their paths; an empty table counts as a value."""
    for name, value in values.items():
        key = (*above, name)
        if isinstance(value, Mapping) and value:
            yield from leaves(value, key)
        else:
            yield key, value


def _is_setting(variable: str) -> bool:
    return variable.upper().startswith(ENV_PREFIX) and variable.upper() != CONFIG_VARIABLE


def _unknown_sections() -> Iterator[Entry]:
    """Variables of the nested form whose section does not exist: surely a slip of the pen."""
    for variable, value in os.environ.items():
        section, delimiter, rest = variable[len(ENV_PREFIX) :].lower().partition(ENV_DELIMITER)
        if _is_setting(variable) and delimiter and section not in Settings.model_fields:
            key = (section, *rest.split(ENV_DELIMITER))
            yield Entry(key, value, f"environment variable {variable}")


def _variable_of(key: Key) -> str:
    """The variable that set a key: its own, or that of a table around it."""
    present = {name.upper(): name for name in os.environ}
    for length in range(len(key), 0, -1):
        name = ENV_PREFIX + ENV_DELIMITER.join(key[:length]).upper()
        if name in present:
            return f"environment variable {present[name]}"
    return "an environment variable"
