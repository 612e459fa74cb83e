"""The two WebSockets: live state with its commands, and the 3D picture."""

from __future__ import annotations

import json
import random
import time
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection
from websockets.typing import Origin

from server.api.twin.bridge import SUBPROTOCOL
from tests.campaign.fuzz.target import BrokenError, mutated
from tests.support.process import ServerProcess
from tests.support.twin_client import CAMERA_MESSAGE

MESSAGES: tuple[dict[str, Any], ...] = (
    {"type": "stop", "id": 1},
    {"type": "emergency_stop", "id": 2},
    {"type": "jog", "id": 3, "axis": "x", "direction": 1, "speed_mm_s": 5.0},
    {
        "type": "jog_step",
        "id": 4,
        "step": {"axis": "rho1", "distance_mm": 1.0, "speed_mm_s": 5.0},
    },
    {"type": "jog_end", "id": 5},
    {"type": "resync", "id": 6},
)
VALUES: tuple[Any, ...] = (None, True, -1, 0, 1e308, 2**70, "", "x" * 300, [], {}, [[]], "\u0000")
PER_CONNECTION = 15
"""After 20 that do not fit the server hangs up."""

STOP_ID = 4242
ANSWER_S = 5.0


class LiveSocket:
    """Commands of a paired browser, right and wrong; a stop must work after all of them."""

    name = "messages of the pages"

    def __init__(self, server: ServerProcess, rng: random.Random) -> None:
        self.tried = 0
        self._server = server
        self._rng = rng
        self._address = server.url.replace("http", "ws", 1) + "/api/v1/ws"

    def run(self, until_s: float) -> None:
        """Try connections, each with some messages and a stop at the end."""
        while time.monotonic() < until_s:
            sent: list[str | bytes] = []
            with connect(
                self._address, additional_headers=self._server.headers, proxy=None
            ) as socket:
                try:
                    for _ in range(self._rng.randint(1, PER_CONNECTION)):
                        sent.append(self._message())
                        socket.send(sent[-1])
                        self.tried += 1
                    socket.send(json.dumps({"type": "stop", "id": STOP_ID}))
                    _expect_stop(socket)
                except (ConnectionClosed, TimeoutError) as error:
                    raise BrokenError(f"no stop after {sent!r}: {error!r}") from error

    def _message(self) -> str | bytes:
        message = dict(self._rng.choice(MESSAGES))
        if self._rng.random() < 0.5:
            field = self._rng.choice([*message, "other"])
            message[field] = self._rng.choice(VALUES)
        text = json.dumps(message)
        if self._rng.random() < 0.4:
            data = mutated(text.encode(), self._rng)
            return data if self._rng.random() < 0.5 else data.decode(errors="replace")
        return text


def _expect_stop(socket: Connection) -> None:
    ends_s = time.monotonic() + ANSWER_S
    while True:
        answer = json.loads(socket.recv(timeout=max(0.0, ends_s - time.monotonic())))
        problem = answer.get("problem") or {}
        if problem.get("status") == 500:
            raise BrokenError(f"the server failed: {problem}")
        if answer.get("id") == STOP_ID:
            if not answer["ok"]:
                raise BrokenError(f"the stop was refused: {answer}")
            return


class TwinSocket:
    """Messages to the 3D picture; it may hang up, but it must come back."""

    name = "messages to the 3D picture"

    def __init__(self, server: ServerProcess, rng: random.Random) -> None:
        self.tried = 0
        self._server = server
        self._rng = rng
        self._address = server.url.replace("http", "ws", 1) + "/twin/"

    def run(self, until_s: float) -> None:
        """Try connections, each until it is closed or has had enough."""
        while time.monotonic() < until_s:
            try:
                with connect(
                    self._address,
                    additional_headers=self._server.headers,
                    origin=Origin(self._server.url),
                    subprotocols=[SUBPROTOCOL],
                    compression=None,
                    max_size=None,
                    proxy=None,
                ) as socket:
                    self._talk(socket)
            except OSError as error:
                raise BrokenError(f"the 3D picture does not come back: {error!r}") from error

    def _talk(self, socket: Connection) -> None:
        try:
            socket.send(CAMERA_MESSAGE)
            for _ in range(self._rng.randint(1, PER_CONNECTION)):
                data = mutated(CAMERA_MESSAGE, self._rng)
                socket.send(data if self._rng.random() < 0.9 else data.decode(errors="replace"))
                self.tried += 1
        except ConnectionClosed:
            return  # it may: nothing of that was a message
