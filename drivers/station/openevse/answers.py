"""What the OpenEVSE answers."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from drivers.station.errors import StationAnswerError, StationStaleError
from drivers.station.protocol import PilotState
from drivers.station.web import Answer

CHARGING = 3
NEEDS_VENTILATION = 4
STUCK_RELAY = 8
SLEEPING, DISABLED = 254, 255

Reading = Annotated[float, Field(ge=-1e6, le=1e6)]
Flag = Annotated[int, Field(ge=0, le=1)]


class Status(Answer):
    """GET /status, and the parts of it that are needed.

    Attributes:
        state: 1 not connected, 2 connected, 3 charging, 4-11 faults, 254 sleeping, 255 disabled.
        status: What the WiFi module wants.
        vehicle: A car is connected.
        amp: Current [mA].
        power: [W].
        session_energy: Energy since the car was connected [Wh].
        manual_override: Somebody has overridden it.
        evse_connected: The WiFi module hears its charge controller; older ones do not say.
        time: Its clock.
    """

    state: Annotated[int, Field(ge=0, le=255)]
    status: str
    vehicle: Flag
    amp: Reading
    power: Reading
    session_energy: Annotated[float, Field(ge=0, le=1e6)]
    manual_override: Flag
    evse_connected: Flag | None = None
    time: str | None = None

    @property
    def current_a(self) -> float:
        """Size of the current, whichever way the meter is mounted [A]."""
        return abs(self.amp) / 1000.0

    @property
    def contactor_closed(self) -> bool:
        """The power contacts are closed, as far as it knows."""
        return self.state in {CHARGING, NEEDS_VENTILATION, STUCK_RELAY}

    @property
    def enabled(self) -> bool:
        """Either part of it is willing to give power."""
        return self.status == "active" or self.state not in {SLEEPING, DISABLED}

    def pilot(self, name: str) -> PilotState:
        """Control pilot state.

        Args:
            name: Name of the station, for messages.

        Raises:
            StationStaleError: the WiFi module has no connection to its charge controller.
            StationAnswerError: there is no such state.
        """
        if self.evse_connected == 0:
            raise StationStaleError(
                f"The WiFi module of {name} does not hear its charge controller. "
                "Check the cable between them, and restart the station."
            )
        if self.state in {SLEEPING, DISABLED}:
            return PilotState.B if self.vehicle else PilotState.A
        known = {1: PilotState.A, 2: PilotState.B, CHARGING: PilotState.C}
        if self.state in known:
            return known[self.state]
        if NEEDS_VENTILATION <= self.state <= 11:
            return PilotState.F
        raise StationAnswerError(
            f"{name} reports the state {self.state}, which nobody knows. Wait until it has "
            "started; if that does not help, bring its firmware up to date."
        )


class Override(Answer):
    """GET /override; empty without one."""

    state: Literal["active", "disabled"] | None = None
    auto_release: bool = True


class Limit(Answer):
    """GET /limit: the session ends there."""

    type: str = "none"
    value: Annotated[float, Field(ge=0)] = 0
    auto_release: bool = True


class Pushed(Answer):
    """A message of the WebSocket: what has changed."""

    state: int | None = None
    amp: float | None = None
    vehicle: int | None = None

    @property
    def shows_load(self) -> bool:
        """It tells of a load."""
        closed = self.state in {CHARGING, NEEDS_VENTILATION, STUCK_RELAY}
        return closed or (self.amp is not None and abs(self.amp) >= 500.0)
