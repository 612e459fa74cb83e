"""An OCPP 1.6-J station behind the station protocol: a central system for one charge point."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable
from typing import Any

from ocpp.exceptions import OCPPError
from ocpp.v16 import call
from websockets.asyncio.server import Server, ServerConnection
from websockets.exceptions import ConnectionClosed

from drivers.station.errors import (
    StationAnswerError,
    StationHeldError,
    StationNotOpenError,
    StationRefusedError,
    StationSilentError,
    StationStaleError,
    StationUnreachableError,
    StationUnsupportedError,
)
from drivers.station.memory import StationMemory
from drivers.station.ocpp16.clock import StationClock
from drivers.station.ocpp16.listening import PROTOCOL, listen
from drivers.station.ocpp16.point import ConnectedPoint
from drivers.station.ocpp16.profile import current_profile
from drivers.station.protocol import PilotState, StationCapabilities, StationSnapshot
from drivers.station.settings import OcppSettings

_log = logging.getLogger(__name__)

CHARGING = "Charging"
MARGIN_S = 0.5
ENABLED = {CHARGING, "SuspendedEV", "SuspendedEVSE"}
CONFIGURATION = {
    "MeterValuesSampledData": "Energy.Active.Import.Register,Power.Active.Import,Current.Import",
    "MeterValueSampleInterval": "2",
}


class OcppStation:
    """Implements StationDriver.

    Args:
        settings: Where to listen, and for whom.
        memory: Keeps the hold and the transaction.
    """

    def __init__(self, settings: OcppSettings, memory: StationMemory) -> None:
        self._settings = settings
        self._memory = memory
        self._hold_name = f"ocpp {settings.charge_point} hold"
        self._server: Server | None = None
        self._clock: StationClock | None = None
        self._point: ConnectedPoint | None = None
        self._untriggered: set[str] = set()
        self._listeners: list[Callable[[], None]] = []
        self.connected = asyncio.Event()

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return f"Station {self._settings.charge_point}"

    @property
    def capabilities(self) -> StationCapabilities:
        """Whether it unlocks is for the configuration to say: few stations with a cable do."""
        timeout_s = self._settings.timeout_s
        return StationCapabilities(
            switches=True,
            holds=True,
            unlocks=self._settings.unlocks,
            limits_current=True,
            reads_within_s=4 * timeout_s + MARGIN_S,  # two triggers, two messages
            acts_within_s=3 * timeout_s + MARGIN_S,
        )

    @property
    def port(self) -> int:
        """Where it listens.

        Raises:
            StationNotOpenError: it does not.
        """
        if self._server is None:
            raise StationNotOpenError(f"{self.name} is not connected: open it first.")
        port: int = next(iter(self._server.sockets)).getsockname()[1]
        return port

    async def open(self) -> None:
        """Listen; the station connects when it wants to.

        Raises:
            StationUnreachableError: the port is taken.
        """
        if self._server is None:
            self._clock = StationClock(self._settings.clock_tolerance_s)
            self._server = await listen(self._settings, self._talk)

    async def close(self) -> None:
        """Disconnect; the station goes on by itself. Safe to call twice."""
        server, self._server = self._server, None
        if server is not None:
            server.close()
            await server.wait_closed()
        self._point = None

    async def snapshot(self) -> StationSnapshot:
        """Have the station tell its status and meter, and read them.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        point = self._require_point()
        asked_s = asyncio.get_running_loop().time()
        for message in ("StatusNotification", "MeterValues"):
            await self._have_told(point, message, asked_s)
        status, meter = point.status, point.meter
        if status is None or meter is None or point.status_s is None or point.meter_s is None:
            raise StationStaleError(
                f"{self.name} has not told its status and meter values. "
                "Look whether it sends MeterValues with power or current."
            )
        held = await self._memory.get(self._hold_name) is not None
        energy_wh = (meter.energy_wh or 0.0) - (await point.transaction()).meter_start_wh
        return StationSnapshot(
            sampled_at_s=min(point.status_s, point.meter_s),
            pilot=self._pilot(status, plugged=point.plugged),
            enabled=status in ENABLED,
            held=held and status == "Unavailable",
            contactor_closed=status == CHARGING,
            connector_locked=None,
            power_w=meter.power_w or 0.0,
            currents_a=meter.all_currents_a,
            session_energy_wh=max(energy_wh, 0.0),
        )

    async def start(self) -> None:
        """Begin a transaction.

        Raises:
            StationHeldError: a hold of ours is in force.
        """
        if await self._memory.get(self._hold_name) is not None:
            raise StationHeldError(f"{self.name} is held; release it before it may give power.")
        settings = self._settings
        await self._command(
            call.RemoteStartTransaction(id_tag=settings.id_tag, connector_id=settings.connector)
        )

    async def stop(self) -> None:
        """End the transaction, if there is one."""
        point = self._require_point()
        await self._have_told(point, "StatusNotification", asyncio.get_running_loop().time())
        transaction = await point.transaction()
        if transaction.running:
            said = await self._call(call.RemoteStopTransaction(transaction_id=transaction.number))
            if said == "Rejected" and point.status not in ENABLED:
                # It ended while nobody listened.
                await point.forget_transaction()
                return
            self._check("RemoteStopTransaction", said, {"Accepted"})
        elif point.status in ENABLED:
            raise StationRefusedError(
                f"{self.name} charges in a transaction that it never told. "
                "End the charging at the station."
            )

    async def hold(self) -> None:
        """Make the connector inoperative."""
        await self._memory.put(self._hold_name, "inoperative")
        await self._available("Inoperative")

    async def release(self) -> None:
        """Make the connector operative."""
        await self._available("Operative")
        await self._memory.put(self._hold_name, None)

    async def unlock(self) -> None:
        """Open the connector lock.

        Raises:
            StationUnsupportedError: it has none.
        """
        said = await self._call(call.UnlockConnector(connector_id=self._settings.connector))
        if said == "NotSupported":
            raise StationUnsupportedError(
                f"{self.name} cannot unlock. Set station.ocpp.unlocks = false."
            )
        self._check("UnlockConnector", said, {"Unlocked"})

    async def limit_current(self, current_a: float) -> None:
        """Set the profile of all transactions to come, and of the running one.

        Raises:
            StationUnsupportedError: it has no smart charging.
        """
        said = await self._call(
            call.SetChargingProfile(
                connector_id=self._settings.connector,
                cs_charging_profiles=current_profile(current_a),
            )
        )
        if said == "NotSupported":
            raise StationUnsupportedError(
                f"{self.name} has no smart charging: set its current at the station."
            )
        self._check("SetChargingProfile", said, {"Accepted"})

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` with every new status that it sends."""
        self._listeners.append(listener)

    # --- inside ------------------------------------------------------------------------------

    def _news(self) -> None:
        for listener in self._listeners:
            listener()

    async def _talk(self, connection: ServerConnection) -> None:
        if connection.subprotocol != PROTOCOL or self._clock is None:
            await connection.close(1002, "ocpp1.6 only")
            return
        self._clock.connected()
        point = ConnectedPoint(
            self._settings.charge_point,
            connection,
            connector=self._settings.connector,
            clock=self._clock,
            memory=self._memory,
            timeout_s=self._settings.timeout_s,
            changed=self._news,
        )
        # The newest connection counts: after a broken one the old may seem alive for a while.
        self._point = point
        self._untriggered.clear()
        self.connected.set()
        configuring = asyncio.create_task(self._configure(point), name="OCPP configuration")
        try:
            await point.start()
        except ConnectionClosed:
            _log.info("%s has disconnected", self.name)
        finally:
            configuring.cancel()
            await asyncio.wait([configuring])
            if self._point is point:
                self._point = None
                self.connected.clear()

    async def _configure(self, point: ConnectedPoint) -> None:
        for key, value in CONFIGURATION.items():
            with contextlib.suppress(TimeoutError, OCPPError, ConnectionClosed):
                answer = await point.call(call.ChangeConfiguration(key=key, value=value))
                _log.info("%s: %s %s", self.name, key, getattr(answer, "status", "refused"))

    async def _have_told(self, point: ConnectedPoint, message: str, asked_s: float) -> None:
        """Wait for a message that was sent after it was asked for."""
        if message in self._untriggered:
            return
        request = call.TriggerMessage(message, connector_id=self._settings.connector)
        said = await self._call(request)
        if said == "NotImplemented":
            self._untriggered.add(message)
        if said != "Accepted":
            return

        def told() -> bool:
            told_s = point.status_s if message == "StatusNotification" else point.meter_s
            return told_s is not None and told_s >= asked_s

        try:
            async with asyncio.timeout(self._settings.timeout_s), point.news:
                await point.news.wait_for(told)
        except TimeoutError:
            if point.late_s > 0.0:
                raise StationStaleError(
                    f"What {self.name} sends is {point.late_s:.0f} s old by its clock. "
                    "If that persists, its clock is wrong: set it, or restart the station."
                ) from None
            raise StationSilentError(
                f"{self.name} promised a {message} and did not send it. Restart the station."
            ) from None

    def _pilot(self, status: str, *, plugged: bool) -> PilotState:
        if status == "Faulted":
            return PilotState.F
        if status == CHARGING:
            return PilotState.C
        # "Unavailable" hides whether a car is connected: it is as it was before.
        return PilotState.B if plugged else PilotState.A

    async def _available(self, kind: str) -> None:
        request = call.ChangeAvailability(connector_id=self._settings.connector, type=kind)
        self._check("ChangeAvailability", await self._call(request), {"Accepted", "Scheduled"})

    async def _command(self, request: Any) -> None:  # noqa: ANN401 - the library has no base class
        self._check(type(request).__name__, await self._call(request), {"Accepted"})

    def _check(self, what: str, said: str, good: set[str]) -> None:
        if said not in good:
            raise StationRefusedError(
                f"{self.name} answered {said!r:.40} to {what}. "
                "Look at its display, and restart it if that persists."
            )

    async def _call(self, request: Any) -> str:  # noqa: ANN401 - the library has no base class
        """Send a request and return the status that the station answers."""
        point = self._require_point()
        what = type(request).__name__
        try:
            async with asyncio.timeout(self._settings.timeout_s):
                answer = await point.call(request, suppress=False)
        except TimeoutError:
            raise StationSilentError(
                f"{self.name} did not answer {what} within {self._settings.timeout_s:g} s. "
                "Check its power and the network."
            ) from None
        except ConnectionClosed as error:
            raise StationUnreachableError(
                f"{self.name} has disconnected. Check its power and the network."
            ) from error
        except OCPPError as error:
            raise StationAnswerError(
                f"{self.name} answered {what} with an error ({error.code}). "
                "Bring its firmware up to date."
            ) from error
        return str(answer.status)

    def _require_point(self) -> ConnectedPoint:
        if self._server is None:
            raise StationNotOpenError(f"{self.name} is not connected: open it first.")
        if self._point is None:
            raise StationUnreachableError(
                f"{self.name} has not connected. Let it connect to "
                f"ws://(this computer):{self._settings.port}/ocpp/{self._settings.charge_point}."
            )
        return self._point
