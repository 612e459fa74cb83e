"""One connection of the charge point: what it tells, and what it is asked."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar, cast

from ocpp.routing import on
from ocpp.v16 import ChargePoint, call_result
from ocpp.v16.enums import AuthorizationStatus, RegistrationStatus
from pydantic import BaseModel, ConfigDict

from drivers.station.memory import StationMemory
from drivers.station.ocpp16.clock import StationClock
from drivers.station.ocpp16.meter import MeterReading, read_meter

_log = logging.getLogger(__name__)
_wire_log = logging.getLogger("ocpp")
_wire_log.setLevel(logging.WARNING)

HEARTBEAT_S = 60

F = TypeVar("F", bound=Callable[..., object])


def _answers(action: str) -> Callable[[F], F]:
    """The decorator of the library, with types."""
    return cast("Callable[[F], F]", on(action))


class Transaction(BaseModel):
    """The last transaction, kept over a restart.

    Attributes:
        number: Its id.
        running: It has not ended.
        meter_start_wh: Register of the meter at its beginning [Wh].
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    number: int = 0
    running: bool = False
    meter_start_wh: float = 0.0


class ConnectedPoint(ChargePoint):  # type: ignore[misc]  # the library has no types
    """Answers the station and keeps the newest of what it says.

    Args:
        identity: Of the charge point.
        connection: WebSocket.
        connector: The one that the robot uses.
        clock: Of the station.
        memory: Keeps the transaction.
        timeout_s: Longest wait for an answer [s].
        changed: Called when the station tells another status.

    Attributes:
        status: Newest status of the connector.
        status_s: When it was so, event loop time [s].
        plugged: A car is connected, or was before the connector became unavailable.
        meter: Newest meter values of the connector.
        meter_s: When they were so, event loop time [s].
        late_s: How old the last message was when it arrived, by the station's clock [s].
    """

    def __init__(
        self,
        identity: str,
        connection: Any,  # noqa: ANN401 - the library takes anything with recv and send
        *,
        connector: int,
        clock: StationClock,
        memory: StationMemory,
        timeout_s: float,
        changed: Callable[[], None] = lambda: None,
    ) -> None:
        super().__init__(identity, connection, timeout_s, _wire_log)
        self._connector = connector
        self._clock = clock
        self._memory = memory
        self._memory_name = f"ocpp {identity} transaction"
        self.news = asyncio.Condition()
        self._changed = changed
        self.late_s = 0.0
        self.status: str | None = None
        self.status_s: float | None = None
        self.plugged = False
        self.meter: MeterReading | None = None
        self.meter_s: float | None = None

    async def transaction(self) -> Transaction:
        """The running transaction, or the last one."""
        text = await self._memory.get(self._memory_name)
        return Transaction() if text is None else Transaction.model_validate_json(text)

    async def forget_transaction(self) -> None:
        """The station does not know the running transaction any more."""
        await self._keep((await self.transaction()).model_copy(update={"running": False}))

    async def _keep(self, transaction: Transaction) -> None:
        await self._memory.put(self._memory_name, transaction.model_dump_json())

    def _sampled_s(self, stamp: str | None) -> float:
        arrived_s = asyncio.get_running_loop().time()
        sampled_s = self._clock.sampled_s(stamp, arrived_s)
        self.late_s = arrived_s - sampled_s
        return sampled_s

    # --- what the station says; the names of the arguments are those of OCPP -------------------

    @_answers("BootNotification")
    async def _boot(self, **_: object) -> call_result.BootNotification:
        return call_result.BootNotification(
            current_time=self._clock.now().isoformat(),
            interval=HEARTBEAT_S,
            status=RegistrationStatus.accepted,
        )

    @_answers("Heartbeat")
    async def _heartbeat(self) -> call_result.Heartbeat:
        return call_result.Heartbeat(current_time=self._clock.now().isoformat())

    @_answers("Authorize")
    async def _authorize(self, **_: object) -> call_result.Authorize:
        return call_result.Authorize({"status": AuthorizationStatus.accepted})

    @_answers("DataTransfer")
    async def _data(self, **_: object) -> call_result.DataTransfer:
        return call_result.DataTransfer("UnknownVendorId")

    @_answers("StatusNotification")
    async def _status(
        self, connector_id: int, status: str, timestamp: str | None = None, **_: object
    ) -> call_result.StatusNotification:
        sampled_s = self._sampled_s(timestamp)
        newest = self.status_s is None or sampled_s >= self.status_s
        if connector_id == self._connector and newest:
            is_news = status != self.status
            async with self.news:
                self.status, self.status_s = status, sampled_s
                if status != "Unavailable":
                    self.plugged = status not in {"Available", "Reserved", "Faulted"}
                self.news.notify_all()
            if is_news:
                self._changed()
        return call_result.StatusNotification()

    @_answers("MeterValues")
    async def _meter_values(
        self,
        connector_id: int,
        meter_value: Sequence[Mapping[str, Any]],
        transaction_id: int | None = None,
        **_: object,
    ) -> call_result.MeterValues:
        if connector_id == self._connector:
            for value in meter_value:
                await self._take_meter(value)
            known = await self.transaction()
            if transaction_id is not None and transaction_id > known.number:
                # It began with another central system.
                await self._keep(Transaction(number=transaction_id, running=True))
        return call_result.MeterValues()

    async def _take_meter(self, value: Mapping[str, Any]) -> None:
        try:
            sampled_s = self._sampled_s(value["timestamp"])
            reading = read_meter(value["sampled_value"])
        except (ValueError, KeyError) as error:
            _log.warning("the station sent a meter value that makes no sense: %s", error)
            return
        newest = self.meter_s is None or sampled_s >= self.meter_s
        if newest and reading.shows_load:
            async with self.news:
                self.meter, self.meter_s = reading, sampled_s
                self.news.notify_all()

    @_answers("StartTransaction")
    async def _start(self, meter_start: int, **_: object) -> call_result.StartTransaction:
        number = (await self.transaction()).number + 1
        await self._keep(
            Transaction(number=number, running=True, meter_start_wh=float(meter_start))
        )
        return call_result.StartTransaction(number, {"status": AuthorizationStatus.accepted})

    @_answers("StopTransaction")
    async def _stop(self, transaction_id: int, **_: object) -> call_result.StopTransaction:
        known = await self.transaction()
        if transaction_id == known.number:
            await self._keep(known.model_copy(update={"running": False}))
        return call_result.StopTransaction()
