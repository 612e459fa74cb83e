"""Errors of the configuration. They stop the start; the command line shows them as sentences.

ConfigurationError
├── ConfigurationFileError   the file cannot be read, or is not TOML
└── InvalidSettingsError     values or keys that cannot be; lists all of them
"""

from __future__ import annotations

from typing import ClassVar

from server.errors import PlugPilotError


class ConfigurationError(PlugPilotError):
    """PlugPilot cannot start with what it was told."""

    code: ClassVar[str] = "configuration_error"
    title: ClassVar[str] = "PlugPilot cannot start like this"
    remedy: ClassVar[str] = "Correct the configuration and start again."


class ConfigurationFileError(ConfigurationError):
    """The configuration file cannot be read, or is not TOML."""

    code: ClassVar[str] = "configuration_file_unreadable"
    title: ClassVar[str] = "The configuration file cannot be read"


class InvalidSettingsError(ConfigurationError):
    """Some settings cannot be; the detail lists each with its key, value and origin."""

    code: ClassVar[str] = "settings_invalid"
    title: ClassVar[str] = "Some settings cannot be"
