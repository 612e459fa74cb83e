"""An OpenEVSE as its WiFi firmware behaves: claims with priorities, and pushes."""

from __future__ import annotations

import base64
from typing import Any

from fastapi import FastAPI, Request, Response, WebSocket, WebSocketDisconnect
from fastapi.responses import JSONResponse
from starlette.middleware.base import RequestResponseEndpoint

OVERRIDE_PRIORITY, LIMIT_PRIORITY = 1000, 1100


class FakeOpenevse:
    """The station, the car and the WiFi module. Times do not pass by themselves."""

    def __init__(self, password: str | None = None) -> None:
        self.connected = False
        self.session_wh = 0.0
        self.override: dict[str, Any] | None = None
        self.limit: dict[str, Any] | None = None
        self.fields: dict[str, Any] = {}
        self.requests: list[str] = []
        self.closed_after: list[str] = []
        """What the requests were after which the contactor closed."""
        self._login = (
            password and "Basic " + base64.b64encode(f"admin:{password}".encode()).decode()
        )
        self._sockets: list[WebSocket] = []
        self.app = self._make_app()

    def plug(self, session_wh: float = 0.0) -> None:
        self.connected, self.session_wh = True, session_wh

    def unplug(self) -> None:
        self.connected, self.session_wh = False, 0.0
        if self.override and self.override.get("auto_release"):
            self.override = None
        if self.limit and self.limit.get("auto_release"):
            self.limit = None

    @property
    def active(self) -> bool:
        """What the claim of the highest priority wants; without any, it is active."""
        claims = []
        if self.override and "state" in self.override:
            claims.append((OVERRIDE_PRIORITY, self.override["state"]))
        if self.limit and self.limit["type"] == "energy" and self.session_wh >= self.limit["value"]:
            claims.append((LIMIT_PRIORITY, "disabled"))
        return max(claims)[1] == "active" if claims else True

    @property
    def charging(self) -> bool:
        return self.connected and self.active

    def status(self) -> dict[str, Any]:
        state = (3 if self.connected else 1) if self.active else 254
        return {
            "state": state,
            "status": "active" if self.active else "disabled",
            "vehicle": int(self.connected),
            "amp": 30000 if self.charging else 0,
            "voltage": 240,
            "power": 7200 if self.charging else 0,
            "pilot": 32,
            "manual_override": int(self.override is not None),
            "session_energy": self.session_wh,
            **self.fields,
        }

    async def push(self, message: str) -> None:
        for socket in self._sockets:
            await socket.send_text(message)

    def _make_app(self) -> FastAPI:
        app = FastAPI()

        @app.middleware("http")
        async def check(request: Request, call_next: RequestResponseEndpoint) -> Response:
            if self._login and request.headers.get("authorization") != self._login:
                return Response(status_code=401)
            self.requests.append(f"{request.method} {request.url.path}")
            was = self.charging
            response = await call_next(request)
            if self.charging and not was:
                self.closed_after.append(self.requests[-1])
            return response

        @app.get("/status")
        async def status() -> dict[str, Any]:
            return self.status()

        @app.get("/override")
        async def get_override() -> dict[str, Any]:
            return self.override or {}

        @app.post("/override")
        async def post_override(request: Request) -> Response:
            self.override = await request.json()
            return JSONResponse({"msg": "Created"}, 201)

        @app.delete("/override")
        async def delete_override() -> Response:
            if self.override is None:
                return JSONResponse({"msg": "Failed to release manual override"}, 500)
            self.override = None
            return JSONResponse({"msg": "Deleted"})

        @app.get("/limit")
        async def get_limit() -> dict[str, Any]:
            return self.limit or {}

        @app.post("/limit")
        async def post_limit(request: Request) -> Response:
            self.limit = await request.json()
            return JSONResponse({"msg": "done"}, 201)

        @app.delete("/limit")
        async def delete_limit() -> dict[str, Any]:
            self.limit = None
            return {"msg": "done"}

        @app.websocket("/ws")
        async def push(socket: WebSocket) -> None:
            await socket.accept()
            self._sockets.append(socket)
            try:
                await socket.receive_text()
            except WebSocketDisconnect:
                pass
            finally:
                self._sockets.remove(socket)

        return app
