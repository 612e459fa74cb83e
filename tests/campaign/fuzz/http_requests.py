"""Requests: from the published contract, and bytes that are hardly HTTP at all."""

from __future__ import annotations

import random
import socket
import time
from urllib.parse import urlsplit

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.errors import Unsatisfiable
from schemathesis import Case
from schemathesis.core.result import Ok
from schemathesis.generation import GenerationMode

from server.access.operations import LIMITED
from tests.campaign.fuzz.target import BrokenError, mutated
from tests.support.contract import ENDLESS, SCHEMA, check_answer
from tests.support.process import ServerProcess

BURST = 20
SELDOM = 0.02
"""Of attempts to get in only a few: the server makes whoever tries too often wait."""

RAW_TIMEOUT_S = 15.0
"""The server waits 10 s for the rest of a request."""

MOST_ANSWER_BYTES = 1 << 16


class Rest:
    """Requests that fit the contract or nearly so, as the owner."""

    name = "requests of the API"

    def __init__(self, server: ServerProcess, rng: random.Random) -> None:
        self.tried = 0
        self._server = server
        self._rng = rng
        found = [each.ok() for each in SCHEMA.get_all_operations() if isinstance(each, Ok)]
        self._operations = [
            each for each in found if each.definition.raw["operationId"] not in ENDLESS
        ]

    def run(self, until_s: float) -> None:
        """Try bursts of requests, each burst at one operation."""
        while time.monotonic() < until_s:
            operation = self._rng.choice(self._operations)
            if operation.definition.raw["operationId"] in LIMITED and self._rng.random() > SELDOM:
                continue
            mode = self._rng.choice(list(GenerationMode))

            @seed(self._rng.getrandbits(32))
            @settings(
                max_examples=BURST,
                database=None,
                deadline=None,
                phases=[Phase.generate],
                suppress_health_check=list(HealthCheck),
            )
            @given(case=operation.as_strategy(mode))
            def try_burst(case: Case) -> None:  # type: ignore[type-arg]
                if time.monotonic() < until_s:
                    self.tried += 1
                    check_answer(case, self._server)

            try:
                try_burst()
            except Unsatisfiable:
                continue  # nothing about this operation can be wrong
            except Exception as error:
                raise BrokenError(f"{operation.label}: {_words(error)}") from error


def _words(error: Exception) -> str:
    """What went wrong, also where a second try went well and Hypothesis calls it flaky."""
    if isinstance(error, ExceptionGroup):
        return f"{error}: " + "; ".join(str(each) for each in error.exceptions)
    return str(error)


class RawHttp:
    """Bytes at the port."""

    name = "bytes at the port"

    def __init__(self, server: ServerProcess, rng: random.Random) -> None:
        self.tried = 0
        self._rng = rng
        parts = urlsplit(server.url)
        self._place = (str(parts.hostname), int(parts.port or 80))
        cookie = server.headers["Cookie"]
        host = f"Host: {self._place[0]}:{self._place[1]}\r\nCookie: {cookie}\r\n"
        body = '{"type": "unplug"}'
        self._requests = [
            f"GET /api/v1/robot HTTP/1.1\r\n{host}Connection: close\r\n\r\n",
            f"GET / HTTP/1.0\r\n{host}\r\n",
            f"POST /api/v1/robot/stop HTTP/1.1\r\n{host}Content-Length: 0\r\n\r\n",
            f"POST /api/v1/jobs HTTP/1.1\r\n{host}Content-Type: application/json\r\n"
            f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n{body}",
            f"POST /api/v1/jobs HTTP/1.1\r\n{host}Transfer-Encoding: chunked\r\n\r\n"
            f"{len(body):x}\r\n{body}\r\n0\r\n\r\n",
            f"GET /api/v1/ws HTTP/1.1\r\n{host}Upgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
        ]

    def run(self, until_s: float) -> None:
        """Try connections with one damaged request each, and hang up."""
        while time.monotonic() < until_s:
            data = mutated(self._rng.choice(self._requests).encode(), self._rng)
            self.tried += 1
            answer = self._answer(data)
            status = answer[9:12]
            if answer.startswith(b"HTTP/1.") and status[:1] == b"5" and status != b"503":
                raise BrokenError(f"{data!r} was answered with {answer[:300]!r}")

    def _answer(self, data: bytes) -> bytes:
        try:
            with socket.create_connection(self._place, RAW_TIMEOUT_S) as line:
                line.sendall(data)
                line.shutdown(socket.SHUT_WR)
                return line.recv(MOST_ANSWER_BYTES)
        except ConnectionError:
            return b""  # thrown out: nothing that was meant for anybody
        except TimeoutError as error:
            raise BrokenError(f"{data!r} was neither answered nor thrown out") from error
