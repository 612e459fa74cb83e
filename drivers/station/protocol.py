"""The one protocol of charging stations. Stale or unknown always counts as unsafe."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol


class PilotState(StrEnum):
    """Control pilot states of IEC 61851-1."""

    A = "A"  # no car connected (12 V)
    B = "B"  # car connected, not ready (9 V)
    C = "C"  # charging (6 V)
    D = "D"  # charging with ventilation (3 V)
    E = "E"  # no power at the station
    F = "F"  # station fault


@dataclass(frozen=True, slots=True)
class StationCapabilities:
    """What this kind of station can do beside being read."""

    switches: bool  # start() and stop()
    holds: bool  # hold() outranks other controllers until release()
    unlocks: bool  # unlock() opens the connector lock
    fresh: bool = True  # a reading is as new as the question
    senses_car: bool = True  # the pilot state shows whether a car is connected
    limits_current: bool = False  # limit_current() is obeyed
    reads_within_s: float = 3.0  # snapshot() has answered or failed by then
    acts_within_s: float = 3.0  # so has every other call


@dataclass(frozen=True, slots=True)
class StationSnapshot:
    """One reading of the station.

    Attributes:
        sampled_at_s: When the station was in this state, event loop time [s].
        pilot: Control pilot state.
        enabled: The station is willing to give power.
        held: A hold of ours is in force.
        contactor_closed: The power contacts are closed.
        connector_locked: The connector is latched in the inlet; None when unknown.
        power_w: Active power [W].
        currents_a: Phase currents [A].
        session_energy_wh: Energy since the car was connected [Wh].
    """

    sampled_at_s: float
    pilot: PilotState
    enabled: bool
    held: bool
    contactor_closed: bool
    connector_locked: bool | None
    power_w: float
    currents_a: tuple[float, float, float]
    session_energy_wh: float

    @property
    def carries_load(self) -> bool:
        """Unplugging now would break a current: charging, contacts closed, or 0.5 A or more."""
        return (
            self.pilot in {PilotState.C, PilotState.D}
            or self.contactor_closed
            or max(self.currents_a) >= 0.5
        )


class StationDriver(Protocol):
    """A charging station.

    Calls raise StationError when it does not answer, within the times of its capabilities.
    """

    @property
    def name(self) -> str:
        """Name a person recognises."""
        ...

    @property
    def capabilities(self) -> StationCapabilities:
        """What it can do."""
        ...

    async def open(self) -> None:
        """Connect to the station."""
        ...

    async def close(self) -> None:
        """Disconnect. Safe to call twice."""
        ...

    async def snapshot(self) -> StationSnapshot:
        """Read the station now."""
        ...

    async def start(self) -> None:
        """Allow power."""
        ...

    async def stop(self) -> None:
        """Forbid power; the snapshot shows when it has really gone."""
        ...

    async def hold(self) -> None:
        """Keep the power off against every other controller until release()."""
        ...

    async def release(self) -> None:
        """End the hold."""
        ...

    async def unlock(self) -> None:
        """Open the connector lock."""
        ...

    async def limit_current(self, current_a: float) -> None:
        """Let the car draw no more than this from each phase [A], until it is changed.

        Raises:
            StationUnsupportedError: this kind of station cannot do that.
        """
        ...

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever the station tells by itself that something has changed.

        Stations that only answer never do. Nothing may be concluded from it: read the station.
        """
        ...
