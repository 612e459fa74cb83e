"""Errors of changing settings.

AdjustingError
├── FixedSettingError       this setting cannot be changed while PlugPilot runs
├── ImpossibleSettingError  the settings cannot be so; the context names each
└── NoSuchVersionError      that version is not kept
"""

from __future__ import annotations

from server.errors import PlugPilotError


class AdjustingError(PlugPilotError):
    """The settings stay as they are."""

    code = "settings"
    title = "The settings stay as they are"
    status = 409


class FixedSettingError(AdjustingError):
    """This setting cannot be changed while PlugPilot runs."""

    code = "setting_fixed"
    title = "This setting cannot be changed while PlugPilot runs"
    remedy = "Change the configuration file and start PlugPilot again."


class ImpossibleSettingError(AdjustingError):
    """The settings cannot be so."""

    code = "settings_invalid"
    title = "Some settings cannot be"
    status = 422
    remedy = "Correct the settings that are named and send the request again."


class NoSuchVersionError(AdjustingError):
    """That version of the settings is not kept."""

    code = "no_such_version"
    title = "This version of the settings is not kept"
    status = 404
    remedy = "Read the list of versions again."
