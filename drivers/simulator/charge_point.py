"""What happens inside the simulated station: pilot, contactor, power, lock.

Everything that takes time is a timer of the event loop; between two of them nothing is computed.
"""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable

from drivers.simulator.charging import PowerRamp
from drivers.simulator.world import SimulatedWorld
from drivers.station import PilotState, StationError, StationSnapshot


class ChargePoint:
    """The hardware of the station and the car's end of the cable.

    Args:
        world: Says whether the plug is in, and learns when the connector locks.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self._world = world
        self._numbers = world.parameters.station
        self._rng = world.streams.station
        self._ramp: PowerRamp | None = None
        self._closing: asyncio.TimerHandle | None = None
        self._opening: asyncio.TimerHandle | None = None
        self._full: asyncio.TimerHandle | None = None
        self._energy_before_wh = 0.0
        self._limit_a = math.inf
        self.connected = world.pilot_made
        self.enabled = False
        self.held = False
        self.locked = False
        self.on_idle: Callable[[], None] = lambda: None
        self.on_contactor: Callable[[bool], None] = lambda _closed: None
        world.on_connection(self._connection_changed)

    # --- commands ----------------------------------------------------------------------------

    def enable(self) -> None:
        """Be willing to give power, unless held."""
        if self.held:
            return
        self.enabled = True
        if self._opening is not None:
            self._opening.cancel()
            self._opening = None
        self._offer_power()

    def disable(self) -> None:
        """Give no more power; the contactor opens after the station's reaction time."""
        self.enabled = False
        if self._closing is not None:
            self._closing.cancel()
            self._closing = None
        if self._ramp is None:
            self.on_idle()
        elif self._opening is None:
            self._opening = self._later(self._numbers.stop_reaction_s, self._open_contactor)

    def hold(self) -> None:
        """Keep the power off whatever others want."""
        self.held = True
        self.disable()

    def release(self) -> None:
        """End the hold; the power stays off until somebody enables it."""
        self.held = False
        if not self.enabled:
            self.on_idle()

    def unlock(self) -> None:
        """Open the connector lock.

        Raises:
            StationError: the station is enabled or the contactor is closed.
        """
        if self.enabled or self._ramp is not None:
            raise StationError("The connector stays locked while the station may give power.")
        self._lock(locked=False)

    def limit(self, current_a: float) -> None:
        """Let the car draw no more than this from each phase [A]."""
        self._limit_a = current_a
        if self._ramp is not None:
            now_s = self._now()
            power_w = self._ramp.power_w(now_s)
            self._count_energy(self._ramp)
            self._give_power(from_w=power_w)

    # --- what it shows -----------------------------------------------------------------------

    @property
    def pilot(self) -> PilotState:
        """Control pilot state."""
        if not self.connected:
            return PilotState.A
        return PilotState.C if self._ramp is not None or self._closing else PilotState.B

    @property
    def contactor_closed(self) -> bool:
        """The power contacts are closed."""
        return self._ramp is not None

    def snapshot(self) -> StationSnapshot:
        """What the station measures at this moment."""
        now_s = self._now()
        power_w = self._ramp.power_w(now_s) if self._ramp is not None else 0.0
        power_w *= 1.0 + float(self._rng.normal(0.0, self._numbers.current_noise_std))
        per_phase_a = power_w / (self._numbers.phases * self._numbers.voltage_v)
        currents = [per_phase_a if phase < self._numbers.phases else 0.0 for phase in range(3)]
        return StationSnapshot(
            sampled_at_s=now_s,
            pilot=self.pilot,
            enabled=self.enabled,
            held=self.held,
            contactor_closed=self._ramp is not None,
            connector_locked=self.locked,
            power_w=power_w,
            currents_a=(currents[0], currents[1], currents[2]),
            session_energy_wh=self._session_energy_wh(now_s),
        )

    def _session_energy_wh(self, now_s: float) -> float:
        flowing_wh = self._ramp.energy_wh(now_s) if self._ramp is not None else 0.0
        return self._energy_before_wh + flowing_wh

    # --- what goes on ------------------------------------------------------------------------

    def _offer_power(self) -> None:
        """With the car connected and hungry, go to state C and close the contactor soon."""
        ready = self.connected and self.enabled and self._world.wanted_wh > 0
        if ready and self._ramp is None and self._closing is None:
            self._lock(locked=True)
            delay_s = float(self._rng.uniform(*self._numbers.contactor_closes_s))
            self._closing = self._later(delay_s, self._close_contactor)

    def _close_contactor(self) -> None:
        self._closing = None
        self._give_power(from_w=0.0)
        self.on_contactor(True)

    def _give_power(self, from_w: float) -> None:
        """Ramp from one power to what limit and cable allow, until the car is full."""
        now_s = self._now()
        numbers = self._numbers
        current_a = min(numbers.current_a, self._limit_a)
        full_w = numbers.phases * numbers.voltage_v * current_a
        self._ramp = PowerRamp(now_s, full_w, numbers.ramp_s, from_w)
        full_in_s = self._ramp.reaches_s(self._world.wanted_wh) - now_s
        if self._full is not None:
            self._full.cancel()
        self._full = self._later(full_in_s, self._car_is_full)

    def _count_energy(self, ramp: PowerRamp) -> None:
        energy_wh = ramp.energy_wh(self._now())
        self._energy_before_wh += energy_wh
        self._world.wanted_wh = max(self._world.wanted_wh - energy_wh, 0.0)

    def _open_contactor(self) -> None:
        self._opening = None
        if self._ramp is None:
            return
        self._count_energy(self._ramp)
        self._ramp = None
        self.on_contactor(False)
        if self._full is not None:
            self._full.cancel()
            self._full = None
        if not self.enabled:
            self.on_idle()

    def _car_is_full(self) -> None:
        self._full = None
        self._open_contactor()
        self._world.wanted_wh = 0.0

    def _connection_changed(self, connected: bool, _at_s: float) -> None:
        self.connected = connected
        if connected:
            self._energy_before_wh = 0.0
            self._offer_power()
            return
        if self._closing is not None:
            self._closing.cancel()
            self._closing = None
        if self._opening is not None:
            self._opening.cancel()
            self._opening = None
        if self._ramp is not None:
            # the contacts of plug and socket have parted with the contactor still closed
            self._world.load_breaks += 1
            self._open_contactor()
        self._lock(locked=False)

    def _lock(self, *, locked: bool) -> None:
        if self.locked != locked and self._numbers.car_locks:
            self.locked = locked
            self._world.lock_connector(locked=locked, now_s=self._now())

    def _later(self, delay_s: float, action: Callable[[], None]) -> asyncio.TimerHandle:
        return asyncio.get_running_loop().call_later(delay_s, action)

    @staticmethod
    def _now() -> float:
        return asyncio.get_running_loop().time()
