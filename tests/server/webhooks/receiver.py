"""A webhook target on a real socket, and one that only exists in memory."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass, field
from ipaddress import ip_network

from fastapi import FastAPI, Request, Response

from server.config.webhooks import WebhookSettings
from server.webhooks.sending import Outcome
from tests.support.fake_stations.serving import serving

LOOPBACK = (ip_network("127.0.0.0/8"),)
OPEN = WebhookSettings(allowed_networks=LOOPBACK)


@dataclass
class Received:
    """One request."""

    path: str
    headers: dict[str, str]
    body: str


@dataclass
class Receiver:
    """Answers what it is told to."""

    url: str = ""
    received: list[Received] = field(default_factory=list)
    status: int = 204
    headers: dict[str, str] = field(default_factory=dict)
    body: bytes = b""
    hangs: bool = False

    def make_app(self) -> FastAPI:
        app = FastAPI()

        @app.post("/{path:path}")
        async def receive(path: str, request: Request) -> Response:
            body = (await request.body()).decode()
            self.received.append(Received(path, dict(request.headers), body))
            if self.hangs:
                await asyncio.Event().wait()
            return Response(self.body, self.status, headers=self.headers)

        return app


@contextlib.asynccontextmanager
async def receiving() -> AsyncIterator[Receiver]:
    """A target that answers 204 until it is told otherwise."""
    receiver = Receiver()
    async with serving(receiver.make_app()) as url:
        receiver.url = url
        yield receiver


@dataclass
class SentRequest:
    """What would have been sent, and when."""

    at_s: float
    url: str
    body: str
    headers: Mapping[str, str]


class FakeSender:
    """Sends nothing; answers with what it is told to, the last answer for ever."""

    def __init__(self, *outcomes: Outcome) -> None:
        self.outcomes = list(outcomes)
        self.sent: list[SentRequest] = []
        self.slow: dict[str, float] = {}

    async def send(self, url: str, body: str, headers: Mapping[str, str]) -> Outcome:
        now_s = asyncio.get_running_loop().time()
        self.sent.append(SentRequest(now_s, url, body, headers))
        await asyncio.sleep(self.slow.get(url, 0.01))
        return self.outcomes.pop(0) if len(self.outcomes) > 1 else self.outcomes[0]

    async def close(self) -> None:
        """Nothing is open."""


GOOD = Outcome(204, None)
BAD = Outcome(503, "It answered 503.")
GONE = Outcome(410, "It answered 410.")
