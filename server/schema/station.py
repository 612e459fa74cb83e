"""The charging station as the API shows it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire


class Station(Wire):
    """Newest reading of the charging station."""

    name: str
    online: bool
    pilot: Literal["A", "B", "C", "D", "E", "F"] | None = Field(
        description="Control pilot state of IEC 61851; null while unknown"
    )
    enabled: bool
    held: bool
    contactor_closed: bool
    connector_locked: bool | None
    power_w: float
    currents_a: tuple[float, float, float]
    session_energy_wh: float
    updated_at: Timestamp | None
