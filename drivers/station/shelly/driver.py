"""A Shelly of generation 2 or later behind the station protocol.

A relay does not see the control pilot. With an input for it, it knows whether a car is connected;
without one it says B, which is the side on which no plug is believed to be out. It has no hold.
"""

from __future__ import annotations

from typing import Annotated

import httpx
from pydantic import Field

from drivers.station.errors import (
    StationAnswerError,
    StationUnsupportedError,
)
from drivers.station.protocol import PilotState, StationCapabilities, StationSnapshot
from drivers.station.settings import ShellySettings
from drivers.station.web import Answer, WebDevice
from drivers.station.web_station import WebStation

USER = "admin"
LOAD_A = 0.5

Reading = Annotated[float, Field(ge=-1e6, le=1e6)]


class Counter(Answer):
    """Energy since it was reset [Wh]."""

    total: Annotated[float, Field(ge=0, le=1e12)]


class SwitchStatus(Answer):
    """Switch.GetStatus of a Shelly that measures.

    Attributes:
        output: The relay is closed.
        apower: [W].
        current: [A].
        aenergy: What went through it.
        errors: Such as overtemp; missing without any.
    """

    id: int
    output: bool
    apower: Reading
    current: Reading
    aenergy: Counter
    errors: tuple[str, ...] = ()


class InputStatus(Answer):
    """Input.GetStatus; null where it is a button and no switch."""

    id: int
    state: bool | None


class SetDone(Answer):
    """Switch.Set."""

    was_on: bool


class ShellyStation(WebStation):
    """Implements StationDriver.

    Args:
        settings: Where it is.
    """

    def __init__(self, settings: ShellySettings) -> None:
        secret = settings.password
        auth = httpx.DigestAuth(USER, secret.get_secret_value()) if secret else None
        super().__init__(WebDevice("Shelly", settings.url, settings.timeout_s, auth))
        self._settings = settings
        self._session_began_wh: float | None = None

    @property
    def capabilities(self) -> StationCapabilities:
        """It switches, and sees the car if somebody wired that."""
        senses = self._settings.car_input is not None
        return StationCapabilities(
            switches=True,
            holds=False,
            unlocks=False,
            senses_car=senses,
            **self._web.bounds(2, 1),
        )

    async def _look(self) -> None:
        await self._read_switch()

    async def snapshot(self) -> StationSnapshot:
        """Read the relay now.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        connected = await self._connected()
        switch, asked_s = await self._read_switch()
        current_a = abs(switch.current)
        if not connected or self._session_began_wh is None:
            self._session_began_wh = switch.aenergy.total
        # After its counter was reset, counting begins again.
        self._session_began_wh = min(self._session_began_wh, switch.aenergy.total)
        return StationSnapshot(
            sampled_at_s=asked_s,
            pilot=_pilot(switch, connected=connected),
            enabled=switch.output,
            held=False,
            # The relay in the Shelly is not the contactor of the station behind it.
            contactor_closed=current_a >= LOAD_A,
            connector_locked=None,
            power_w=abs(switch.apower),
            currents_a=(current_a, 0.0, 0.0),
            session_energy_wh=switch.aenergy.total - self._session_began_wh,
        )

    async def start(self) -> None:
        """Close the relay."""
        await self._set(on=True)

    async def stop(self) -> None:
        """Open the relay; the snapshot shows when the current has really gone."""
        await self._set(on=False)

    async def hold(self) -> None:
        """Open the relay; any other client can close it again."""
        await self._set(on=False)

    async def release(self) -> None:
        """Nothing to end: the relay stays open until somebody closes it."""

    async def unlock(self) -> None:
        """A relay has no lock.

        Raises:
            StationUnsupportedError: always.
        """
        raise StationUnsupportedError(f"{self.name} has no lock: open it from the car.")

    async def _connected(self) -> bool:
        number = self._settings.car_input
        if number is None:
            return True
        status, _ = await self._web.read(InputStatus, f"/rpc/Input.GetStatus?id={number}")
        if status.state is None:
            raise StationAnswerError(
                f"Input {number} of {self.name} does not say whether it is on. "
                "Set its type to Switch in the page of the Shelly."
            )
        return status.state

    async def _read_switch(self) -> tuple[SwitchStatus, float]:
        number = self._settings.switch
        return await self._web.read(SwitchStatus, f"/rpc/Switch.GetStatus?id={number}")

    async def _set(self, *, on: bool) -> None:
        number = self._settings.switch
        await self._web.read(SetDone, f"/rpc/Switch.Set?id={number}&on={str(on).lower()}")


def _pilot(switch: SwitchStatus, *, connected: bool) -> PilotState:
    if switch.errors:
        return PilotState.F
    if abs(switch.current) >= LOAD_A:
        return PilotState.C
    return PilotState.B if connected else PilotState.A
