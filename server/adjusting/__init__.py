"""Settings that are changed while PlugPilot runs."""

from server.adjusting.service import RunningSettings

__all__ = ["RunningSettings"]
