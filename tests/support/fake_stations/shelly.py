"""A Shelly of generation 2 with one relay, one input and digest authentication (RFC 7616)."""

from __future__ import annotations

import hashlib
import secrets
from typing import Any

from fastapi import FastAPI, Request, Response
from starlette.middleware.base import RequestResponseEndpoint

REALM = "shellyplus1pm-a8032ab12345"


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


class FakeShelly:
    """The relay, and a car behind it that takes 10 A whenever it can."""

    def __init__(self, password: str | None = None) -> None:
        self.output = False
        self.connected = False
        self.total_wh = 1200.0
        self.fields: dict[str, Any] = {}
        self.input: bool | str | None = "car"
        self._password = password
        self._nonces: set[str] = set()
        self.app = self._make_app()

    def switch(self) -> dict[str, Any]:
        amps = 10.1 if self.output and self.connected else 0.0
        return {
            "id": 0,
            "source": "HTTP_in",
            "output": self.output,
            "apower": 230.0 * amps,
            "voltage": 230.0,
            "current": amps,
            "aenergy": {"total": self.total_wh, "by_minute": [0.0, 0.0, 0.0], "minute_ts": 1},
            "temperature": {"tC": 40.1, "tF": 104.2},
            **self.fields,
        }

    def _may(self, request: Request) -> bool:
        if self._password is None:
            return True
        given = request.headers.get("authorization", "")
        if not given.startswith("Digest "):
            return False
        parts = dict(part.strip().split("=", 1) for part in given[7:].split(","))
        said = {key: text.strip('"') for key, text in parts.items()}
        secret = _sha256(f"admin:{REALM}:{self._password}")
        what = _sha256(f"{request.method}:{said['uri']}")
        middle = f"{said['nonce']}:{said['nc']}:{said['cnonce']}:{said['qop']}"
        return said["nonce"] in self._nonces and said["response"] == _sha256(
            f"{secret}:{middle}:{what}"
        )

    def _challenge(self) -> Response:
        nonce = secrets.token_hex(8)
        self._nonces.add(nonce)
        asks = f'Digest qop="auth", realm="{REALM}", nonce="{nonce}", algorithm=SHA-256'
        return Response(status_code=401, headers={"WWW-Authenticate": asks})

    def _make_app(self) -> FastAPI:
        app = FastAPI()

        @app.middleware("http")
        async def check(request: Request, call_next: RequestResponseEndpoint) -> Response:
            return await call_next(request) if self._may(request) else self._challenge()

        @app.get("/rpc/Switch.GetStatus")
        async def status(id: int) -> dict[str, Any]:  # noqa: A002 - the name in the API
            assert id == 0
            return self.switch()

        @app.get("/rpc/Input.GetStatus")
        async def input_status(id: int) -> dict[str, Any]:  # noqa: A002 - the name in the API
            return {"id": id, "state": self.connected if self.input == "car" else self.input}

        @app.get("/rpc/Switch.Set")
        async def set_(id: int, on: bool) -> dict[str, Any]:  # noqa: A002 - the name in the API
            assert id == 0
            was, self.output = self.output, on
            return {"was_on": was}

        return app
