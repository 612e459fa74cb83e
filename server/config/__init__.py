"""The configuration: one TOML file, environment variables and options, checked in one place."""

from server.config.data_dir import prepare_data_dir
from server.config.errors import (
    ConfigurationError,
    ConfigurationFileError,
    DataDirError,
    InvalidSettingsError,
)
from server.config.layers import Option
from server.config.loading import Configuration, load_configuration, load_settings
from server.config.settings import Settings

__all__ = [
    "Configuration",
    "ConfigurationError",
    "ConfigurationFileError",
    "DataDirError",
    "InvalidSettingsError",
    "Option",
    "Settings",
    "load_configuration",
    "load_settings",
    "prepare_data_dir",
]
