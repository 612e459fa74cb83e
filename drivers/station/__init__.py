"""Charging stations: the protocol every station driver follows."""

from drivers.station.errors import StationError, StationUnsupportedError
from drivers.station.protocol import (
    PilotState,
    StationCapabilities,
    StationDriver,
    StationSnapshot,
)

__all__ = [
    "PilotState",
    "StationCapabilities",
    "StationDriver",
    "StationError",
    "StationSnapshot",
    "StationUnsupportedError",
]
