"""A charge point that speaks OCPP 1.6-J, message for message as a recorded one."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator
from datetime import UTC, datetime, timedelta
from typing import Any

import websockets.asyncio.client
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol


class FakeChargePoint:
    """One connector and a car that takes 16 A whenever it may."""

    def __init__(self) -> None:
        self.plugged = False
        self.operative = True
        self.transaction: int | None = None
        self.energy_wh = 0
        self.clock_ahead_s = 0.0
        self.answers: dict[str, str] = {"UnlockConnector": "NotSupported"}
        """What is answered in place of Accepted."""
        self.deaf = False
        self.silent_triggers = False
        self.heard: list[str] = []
        self.asked: dict[str, dict[str, Any]] = {}
        """The newest question of each kind."""
        self.samples: list[dict[str, str]] | None = None
        self._socket: websockets.asyncio.client.ClientConnection | None = None
        self._own_calls: dict[str, asyncio.Future[dict[str, Any]]] = {}
        self._later: set[asyncio.Task[None]] = set()

    @property
    def status(self) -> str:
        if self.transaction is not None:
            return "Charging"
        if not self.operative:
            return "Unavailable"
        return "Preparing" if self.plugged else "Available"

    def stamp(self, age_s: float = 0.0) -> str:
        moment = datetime.now(UTC) + timedelta(seconds=self.clock_ahead_s - age_s)
        return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")

    @contextlib.asynccontextmanager
    async def connected(self, url: str, login: str | None = None) -> AsyncIterator[None]:
        headers = {"Authorization": login} if login else {}
        async with websockets.asyncio.client.connect(
            url, subprotocols=[Subprotocol("ocpp1.6")], additional_headers=headers, proxy=None
        ) as socket:
            self._socket = socket
            listening = asyncio.create_task(self._listen(socket))
            await self.call(
                "BootNotification",
                {"chargePointVendor": "MicroOcpp", "chargePointModel": "MicroOcpp Simulator"},
            )
            await self.tell_status()
            try:
                yield
            finally:
                for task in {listening, *self._later}:
                    task.cancel()
                await asyncio.gather(listening, *self._later, return_exceptions=True)

    async def call(self, action: str, payload: dict[str, Any]) -> dict[str, Any]:
        assert self._socket is not None
        number = f"cp-{len(self._own_calls)}"
        self._own_calls[number] = asyncio.get_running_loop().create_future()
        await self._socket.send(json.dumps([2, number, action, payload]))
        return await self._own_calls[number]

    async def send(self, text: str) -> None:
        assert self._socket is not None
        await self._socket.send(text)

    async def tell_status(self) -> None:
        await self.call(
            "StatusNotification",
            {
                "connectorId": 1,
                "errorCode": "NoError",
                "status": self.status,
                "timestamp": self.stamp(),
            },
        )

    async def tell_meter(self, *, age_s: float = 0.0, amps: float | None = None) -> None:
        if amps is None:
            amps = 16.0 if self.status == "Charging" else 0.0
        unit = "Energy.Active.Import.Register"
        samples = self.samples or [
            {"value": str(self.energy_wh), "measurand": unit, "unit": "Wh"},
            {"value": f"{amps * 690:.2f}", "measurand": "Power.Active.Import", "unit": "W"},
            {"value": f"{amps:.2f}", "measurand": "Current.Import", "unit": "A"},
        ]
        await self.call(
            "MeterValues",
            {
                "connectorId": 1,
                "meterValue": [{"timestamp": self.stamp(age_s), "sampledValue": samples}],
            },
        )

    async def stop(self, reason: str) -> None:
        number, self.transaction = self.transaction, None
        await self.call(
            "StopTransaction",
            {
                "transactionId": number,
                "meterStop": self.energy_wh,
                "timestamp": self.stamp(),
                "reason": reason,
            },
        )
        await self.tell_status()

    async def start(self) -> None:
        answer = await self.call(
            "StartTransaction",
            {
                "connectorId": 1,
                "idTag": "PLUGPILOT",
                "meterStart": self.energy_wh,
                "timestamp": self.stamp(),
            },
        )
        self.transaction = answer["transactionId"]
        await self.tell_status()

    async def _listen(self, socket: websockets.asyncio.client.ClientConnection) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for text in socket:
                message = json.loads(text)
                if message[0] == 2 and not self.deaf:
                    await self._answer(message[1], message[2], message[3])
                elif message[0] == 3 and message[1] in self._own_calls:
                    self._own_calls[message[1]].set_result(message[2])
                elif message[0] == 4 and message[1] in self._own_calls:
                    self._own_calls[message[1]].set_exception(AssertionError(message))

    async def _answer(self, number: str, action: str, asked: dict[str, Any]) -> None:
        assert self._socket is not None
        self.heard.append(action)
        self.asked[action] = asked
        status = self._decide(action, asked)
        await self._socket.send(json.dumps([3, number, {"status": status}]))
        if status == "Accepted":
            task = asyncio.create_task(self._do(action, asked))
            self._later.add(task)
            task.add_done_callback(self._later.discard)

    def _decide(self, action: str, asked: dict[str, Any]) -> str:
        if action in self.answers:
            return self.answers[action]
        if action == "RemoteStartTransaction":
            return "Accepted" if self.operative and self.plugged else "Rejected"
        if action == "RemoteStopTransaction":
            return "Accepted" if asked["transactionId"] == self.transaction else "Rejected"
        return "Accepted"

    async def _do(self, action: str, asked: dict[str, Any]) -> None:
        if action == "RemoteStartTransaction":
            await self.start()
        elif action == "RemoteStopTransaction":
            await self.stop("Remote")
        elif action == "ChangeAvailability":
            self.operative = asked["type"] == "Operative"
            await self.tell_status()
        elif action == "TriggerMessage" and not self.silent_triggers:
            if asked["requestedMessage"] == "MeterValues":
                await self.tell_meter()
            else:
                await self.tell_status()
