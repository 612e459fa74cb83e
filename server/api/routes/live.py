"""The WebSocket: live sections out, stop and jog in."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import TypeAdapter, ValidationError

from server.api.commanding import admit_command
from server.api.dependencies import ServicesDep
from server.api.errors import InvalidRequestError
from server.api.gate import admit_message, caller_of
from server.errors import InternalError, PlugPilotError
from server.schema.live import (
    ClientMessage,
    EmergencyStopMessage,
    JogEndMessage,
    JogMessage,
    JogStepMessage,
    MoveToMessage,
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
MAX_UNANSWERED = 50
"""A client that sends so much without reading the answers is sent away."""


Errand = Callable[[], Coroutine[Any, Any, None]]


@router.websocket("/ws")
async def live(socket: WebSocket, services: ServicesDep) -> None:
    """One watcher. See ``server.schema.live`` for the messages."""
    await socket.accept()
    await _Connection(socket, services).serve()


class _GoneError(Exception):
    """The other side has closed the socket, or it broke."""


class _Connection:
    """One page, script or phone.

    Every message is dealt with in a task of its own, begun in the order of arrival: a stop waits
    neither for a step that is under way nor for a phone that is slow to take an answer.
    """

    def __init__(self, socket: WebSocket, services: Services) -> None:
        self._socket = socket
        self._services = services
        self._caller = caller_of(socket)
        self._sending = asyncio.Lock()
        self._pushing: asyncio.Task[None] | None = None
        self._jogging = False
        self._errands: set[asyncio.Task[None]] = set()
        self._stops: set[asyncio.Task[None]] = set()

    async def serve(self) -> None:
        self._restart_pushing()
        try:
            await self._receive()
        except _GoneError:
            _log.debug("a watcher has gone")
        finally:
            if self._jogging:
                self._services.jog.release()
            await self._clear_up()

    async def _clear_up(self) -> None:
        """Whoever has gone gets no answers and moves nothing, but a stop is carried out."""
        cancelled = [*self._errands, *([self._pushing] if self._pushing else [])]
        for task in cancelled:
            task.cancel()
        await asyncio.gather(*cancelled, *self._stops, return_exceptions=True)

    async def _receive(self) -> None:
        invalid = 0
        while invalid < MAX_INVALID and len(self._errands) + len(self._stops) < MAX_UNANSWERED:
            raw = await self._next()
            try:
                message = _CLIENT_MESSAGE.validate_json(raw)
            except ValidationError as error:
                invalid += 1
                detail = f"The message does not fit: {error.errors()[0]['msg']}."
                refusal = InvalidRequestError(detail)
                self._begin(self._errands, partial(self._reply, 0, refusal))
                continue
            is_stop = isinstance(message, StopMessage | EmergencyStopMessage)
            self._begin(self._stops if is_stop else self._errands, partial(self._answer, message))
        await self._socket.close(
            POLICY_VIOLATION, "too many messages that do not fit, or unanswered"
        )

    async def _next(self) -> str | bytes:
        try:
            event = await self._socket.receive()
        except RuntimeError as error:  # Starlette's word for a socket that is closed already
            raise _GoneError from error
        if event["type"] != "websocket.receive":
            raise _GoneError
        text: str | None = event.get("text")
        return text if text is not None else bytes(event["bytes"])

    def _begin(self, tasks: set[asyncio.Task[None]], errand: Errand) -> None:
        task = asyncio.create_task(self._until_gone(errand))
        tasks.add(task)
        task.add_done_callback(tasks.discard)

    async def _answer(self, message: ClientMessage) -> None:
        error: PlugPilotError | None = None
        try:
            admit_message(self._services.access, self._caller, message.type)
            admit_command(self._services, self._caller, f"message {message.type}")
            await self._carry_out(message)
        except PlugPilotError as caught:
            error = caught
        except Exception:  # noqa: BLE001 - logged; the connection, and its stops, must go on
            _log.exception("the message %s failed", message.type)
            error = InternalError("The message could not be carried out. The log has the details.")
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
            case MoveToMessage():
                services.technician.targets.hold(message.target_id)
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
        self._pushing = asyncio.create_task(self._until_gone(self._push), name="live push")

    async def _push(self) -> None:
        async for message in self._services.live.watch():
            await self._send(message.decode())

    async def _reply(self, message_id: int, error: PlugPilotError | None) -> None:
        reply = ReplyMessage(
            id=message_id, ok=error is None, problem=problem_from(error) if error else None
        )
        await self._send(reply.model_dump_json())

    async def _send(self, text: str) -> None:
        async with self._sending:
            try:
                await self._socket.send_text(text)
            except (WebSocketDisconnect, RuntimeError) as error:
                raise _GoneError from error

    @staticmethod
    async def _until_gone(errand: Errand) -> None:
        try:
            await errand()
        except _GoneError:
            return  # the receiving side notices too and clears up
