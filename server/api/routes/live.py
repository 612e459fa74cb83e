"""The WebSocket: live sections out, stop and jog in."""

from __future__ import annotations

import asyncio
import logging

from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import TypeAdapter, ValidationError

from server.api.dependencies import ServicesDep
from server.api.errors import InvalidRequestError
from server.errors import PlugPilotError
from server.schema.live import (
    ClientMessage,
    EmergencyStopMessage,
    JogEndMessage,
    JogMessage,
    JogStepMessage,
    ReplyMessage,
    ResyncMessage,
    StopMessage,
)
from server.schema.problem import problem_from
from server.services import Services

_log = logging.getLogger(__name__)

router = APIRouter()

_CLIENT_MESSAGE: TypeAdapter[ClientMessage] = TypeAdapter(ClientMessage)

POLICY_VIOLATION = 1008
MAX_INVALID = 20


@router.websocket("/ws")
async def live(socket: WebSocket, services: ServicesDep) -> None:
    """One watcher. See ``server.schema.live`` for the messages."""
    await socket.accept()
    await _Connection(socket, services).serve()


class _Connection:
    """One page, script or phone."""

    def __init__(self, socket: WebSocket, services: Services) -> None:
        self._socket = socket
        self._services = services
        self._sending = asyncio.Lock()
        self._pushing: asyncio.Task[None] | None = None
        self._jogging = False
        self._steps: set[asyncio.Task[None]] = set()

    async def serve(self) -> None:
        self._restart_pushing()
        try:
            await self._receive()
        except (WebSocketDisconnect, RuntimeError):
            pass  # RuntimeError: Starlette's word for a socket that closed under our hands
        finally:
            if self._jogging:
                self._services.jog.release()
            tasks = [*self._steps, *([self._pushing] if self._pushing else [])]
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _receive(self) -> None:
        invalid = 0
        while invalid < MAX_INVALID:
            text = await self._socket.receive_text()
            try:
                message = _CLIENT_MESSAGE.validate_json(text)
            except ValidationError as error:
                invalid += 1
                detail = f"The message does not fit: {error.errors()[0]['msg']}."
                await self._reply(0, InvalidRequestError(detail))
                continue
            await self._handle(message)
        await self._socket.close(POLICY_VIOLATION, "too many messages that do not fit")

    async def _handle(self, message: ClientMessage) -> None:
        if isinstance(message, JogStepMessage):
            # A step takes its time; a stop behind it must not wait for it.
            step = asyncio.create_task(self._answer(message))
            self._steps.add(step)
            step.add_done_callback(self._steps.discard)
        else:
            await self._answer(message)

    async def _answer(self, message: ClientMessage) -> None:
        error: PlugPilotError | None = None
        try:
            await self._carry_out(message)
        except PlugPilotError as caught:
            error = caught
        if message.id is not None:
            await self._reply(message.id, error)

    async def _carry_out(self, message: ClientMessage) -> None:
        services = self._services
        match message:
            case StopMessage():
                await services.supervisor.stop()
            case EmergencyStopMessage():
                await services.supervisor.emergency_stop()
            case JogMessage():
                services.jog.hold(message.axis, message.direction, message.speed_mm_s)
                self._jogging = True
            case JogEndMessage():
                services.jog.release()
                self._jogging = False
            case JogStepMessage():
                step = message.step
                await services.jog.step(step.axis, step.distance_mm, step.speed_mm_s)
            case ResyncMessage():
                self._restart_pushing()

    def _restart_pushing(self) -> None:
        if self._pushing is not None:
            self._pushing.cancel()
        self._pushing = asyncio.create_task(self._push(), name="live push")

    async def _push(self) -> None:
        try:
            async for message in self._services.live.watch():
                await self._send(message.decode())
        except (WebSocketDisconnect, RuntimeError):
            return  # the receiving side notices too and cleans up

    async def _reply(self, message_id: int, error: PlugPilotError | None) -> None:
        reply = ReplyMessage(
            id=message_id, ok=error is None, problem=problem_from(error) if error else None
        )
        await self._send(reply.model_dump_json())

    async def _send(self, text: str) -> None:
        async with self._sending:
            await self._socket.send_text(text)
