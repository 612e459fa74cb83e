"""The gate alone, with nothing behind it but a note of what it let in."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from starlette.types import Receive, Scope, Send

from server.access import OPERATIONS
from server.api.app import create_app
from server.api.gate import Gate, RouteTable
from server.api.gate.routes import WEBSOCKET, Operation
from server.api.openapi import _never_started
from server.services import Services
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import TwinHost

HOST = "robot"


class FrontDoor:
    """An ASGI application: the gate of the real one, and nothing behind it.

    Attributes:
        operations: What the real application offers.
        let_in: Paths of the requests that got through.
    """

    def __init__(self, services: Services) -> None:
        self._app: FastAPI = create_app(
            _never_started, TwinHost(RobotGeometry(), CameraMount(), 1.0, 4 / 3)
        )
        self._app.state.services = services
        self._gate = Gate(self._behind)
        self.operations = RouteTable(self._app.routes, OPERATIONS).operations
        self.let_in: list[str] = []

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        scope["app"] = self._app
        await self._gate(scope, receive, send)

    async def open_socket(
        self, path: str, headers: dict[str, str], *, host: str = HOST
    ) -> list[dict[str, Any]]:
        """Ask for a WebSocket; returns what the server sent."""
        sent: list[dict[str, Any]] = []

        async def receive() -> dict[str, Any]:
            return {"type": "websocket.connect"}

        async def send(message: Any) -> None:  # noqa: ANN401 - an ASGI message
            sent.append(dict(message))

        everything = {"host": host, "origin": f"http://{host}"} | headers
        scope = {
            "type": "websocket",
            "path": path,
            "scheme": "ws",
            "client": ("192.0.2.7", 50_000),
            "headers": [(k.lower().encode(), v.encode()) for k, v in everything.items()],
        }
        await self(scope, receive, send)
        return sent

    async def _behind(self, scope: Scope, _receive: Receive, send: Send) -> None:
        self.let_in.append(scope["path"])
        if scope["type"] == "websocket":
            await send({"type": "websocket.accept"})
            return
        await send({"type": "http.response.start", "status": 204, "headers": []})
        await send({"type": "http.response.body", "body": b""})


def example_of(operation: Operation) -> tuple[str, str]:
    """Method and path of a request for an operation; its parameters name nothing that exists."""
    path = operation.pattern.pattern.strip("^$").replace("\\", "")
    while "(?P<" in path:
        start, end = path.index("(?P<"), path.index(")")
        path = f"{path[:start]}absent{path[end + 1 :]}"
    if WEBSOCKET in operation.methods:
        return WEBSOCKET, path
    return "GET" if "GET" in operation.methods else min(operation.methods), path
