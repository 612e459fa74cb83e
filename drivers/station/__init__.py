"""Charging stations: the protocol every station driver follows."""

from drivers.station.errors import (
    StationAnswerError,
    StationError,
    StationHeldError,
    StationLoginError,
    StationMemoryError,
    StationNotOpenError,
    StationRefusedError,
    StationSilentError,
    StationStaleError,
    StationUnreachableError,
    StationUnsupportedError,
)
from drivers.station.protocol import (
    PilotState,
    StationCapabilities,
    StationDriver,
    StationSnapshot,
)

__all__ = [
    "PilotState",
    "StationAnswerError",
    "StationCapabilities",
    "StationDriver",
    "StationError",
    "StationHeldError",
    "StationLoginError",
    "StationMemoryError",
    "StationNotOpenError",
    "StationRefusedError",
    "StationSilentError",
    "StationSnapshot",
    "StationStaleError",
    "StationUnreachableError",
    "StationUnsupportedError",
]
