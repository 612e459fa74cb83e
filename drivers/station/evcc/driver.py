"""evcc behind the station protocol.

Its hold is the mode "off"; the mode before is written down first and restored afterwards, also by
a later process. What it says of the station is as old as its interval, so evcc alone never proves
that a plug may be pulled: see drivers/station/managed.py.
"""

from __future__ import annotations

from drivers.station.errors import (
    StationAnswerError,
    StationHeldError,
    StationRefusedError,
    StationUnsupportedError,
)
from drivers.station.evcc.answers import LoadPoint, Mode, Saved, State
from drivers.station.memory import StationMemory
from drivers.station.protocol import PilotState, StationCapabilities, StationSnapshot
from drivers.station.settings import EvccSettings
from drivers.station.web import WebDevice
from drivers.station.web_station import WebStation

VOLTAGE_V = 230.0


class EvccStation(WebStation):
    """Implements StationDriver.

    Args:
        settings: Where it is.
        memory: Keeps the mode that has to be restored.
    """

    def __init__(self, settings: EvccSettings, memory: StationMemory) -> None:
        super().__init__(WebDevice("evcc", settings.url, settings.timeout_s))
        self._settings = settings
        self._memory = memory
        self._memory_name = f"evcc {settings.url} loadpoint {settings.loadpoint}"

    @property
    def capabilities(self) -> StationCapabilities:
        """It knows nothing of now."""
        return StationCapabilities(
            switches=True, holds=True, unlocks=False, fresh=False, **self._web.bounds(1, 3)
        )

    async def _look(self) -> None:
        await self._load_point()

    async def snapshot(self) -> StationSnapshot:
        """What evcc thinks; as old as its interval.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        point, asked_s = await self._load_point()
        saved = await self._saved()
        charging = PilotState.C if point.charging else PilotState.B
        power_w = abs(point.power_w)
        # Without a meter for the currents, all the power may be in one phase.
        currents_a = point.currents_a or (power_w / VOLTAGE_V, 0.0, 0.0)
        return StationSnapshot(
            sampled_at_s=asked_s - self._settings.interval_s,
            pilot=charging if point.connected else PilotState.A,
            enabled=point.enabled or point.mode != "off",
            held=saved is not None and saved.held and point.mode == "off",
            contactor_closed=point.charging,
            connector_locked=None,
            power_w=power_w,
            currents_a=(abs(currents_a[0]), abs(currents_a[1]), abs(currents_a[2])),
            session_energy_wh=point.session_wh,
        )

    async def start(self) -> None:
        """Let evcc charge, in the mode that was stopped.

        Raises:
            StationHeldError: a hold of ours is in force.
        """
        point, _ = await self._load_point()
        saved = await self._saved()
        if point.mode == "off":
            if saved is not None and saved.held:
                raise StationHeldError("evcc is held; release it before it may give power.")
            mode = saved.mode if saved is not None and saved.mode != "off" else None
            await self._set_mode(mode or self._settings.start_mode)
        await self._memory.put(self._memory_name, None)

    async def stop(self) -> None:
        """Mode off; the one before will be restored by start() or release()."""
        saved = await self._saved()
        await self._off(held=saved is not None and saved.held)

    async def hold(self) -> None:
        """Mode off until release()."""
        await self._off(held=True)

    async def release(self) -> None:
        """Restore the mode before, unless somebody has chosen another one meanwhile."""
        saved = await self._saved()
        if saved is None:
            return
        point, _ = await self._load_point()
        if point.mode == "off" and saved.mode != "off":
            await self._set_mode(saved.mode)
        await self._memory.put(self._memory_name, None)

    async def unlock(self) -> None:
        """It has no lock.

        Raises:
            StationUnsupportedError: always.
        """
        raise StationUnsupportedError("evcc cannot unlock a plug: open it from the car.")

    async def _off(self, *, held: bool) -> None:
        """Write the mode down before it is lost, then switch off."""
        point, _ = await self._load_point()
        saved = await self._saved()
        # Somebody may have chosen another mode since: that is the one to come back to.
        mode = saved.mode if saved is not None and point.mode == "off" else point.mode
        await self._memory.put(self._memory_name, Saved(mode=mode, held=held).model_dump_json())
        if point.mode != "off":
            await self._set_mode("off")

    async def _set_mode(self, mode: Mode) -> None:
        await self._web.call("POST", f"/api/loadpoints/{self._settings.loadpoint}/mode/{mode}")
        point, _ = await self._load_point()
        if point.mode != mode:
            raise StationRefusedError(
                f"evcc took the mode {mode} but is in the mode {point.mode}. "
                "Look who else controls it."
            )

    async def _saved(self) -> Saved | None:
        text = await self._memory.get(self._memory_name)
        return None if text is None else self._web.parse(Saved, text)

    async def _load_point(self) -> tuple[LoadPoint, float]:
        state, asked_s = await self._web.read(State, "/api/state")
        number = self._settings.loadpoint
        if number > len(state.loadpoints):
            raise StationAnswerError(
                f"evcc has {len(state.loadpoints)} load points, so there is no number {number}. "
                "Correct `loadpoint` in the configuration."
            )
        return state.loadpoints[number - 1], asked_s
