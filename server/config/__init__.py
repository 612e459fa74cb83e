"""The configuration: one TOML file, environment variables and options, checked in one place."""

from server.config.errors import (
    ConfigurationError,
    ConfigurationFileError,
    InvalidSettingsError,
)
from server.config.layers import Option
from server.config.loading import Configuration, load_configuration, load_settings
from server.config.settings import Settings

__all__ = [
    "Configuration",
    "ConfigurationError",
    "ConfigurationFileError",
    "InvalidSettingsError",
    "Option",
    "Settings",
    "load_configuration",
    "load_settings",
]
