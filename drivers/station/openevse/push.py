"""Listens to the WebSocket of the OpenEVSE, which tells at once what changes.

A push can only make a reading look worse than it is, never better: it is no proof of safety.
"""

from __future__ import annotations

import asyncio
import base64
import logging
import math
from collections.abc import Callable

import websockets.asyncio.client
from pydantic import ValidationError
from websockets.exceptions import InvalidHandshake, InvalidURI, WebSocketException

from drivers.station.openevse.answers import Pushed
from drivers.station.settings import OpenevseSettings

_log = logging.getLogger(__name__)

LONGEST_PAUSE_S = 30.0


class LoadWatch:
    """Notes when the station last told of a load.

    Args:
        settings: Where the station is.
    """

    def __init__(self, settings: OpenevseSettings) -> None:
        self._settings = settings
        self._task: asyncio.Task[None] | None = None
        self.connected = asyncio.Event()
        self.load_seen_s = -math.inf
        self._newest: Pushed | None = None
        self._listeners: list[Callable[[], None]] = []

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever state, current or car change."""
        self._listeners.append(listener)

    def start(self) -> None:
        """Listen, and connect again whenever the connection breaks."""
        if self._task is None:
            self._task = asyncio.create_task(self._run(), name="OpenEVSE push")

    async def close(self) -> None:
        """Listen no more. Safe to call twice."""
        task, self._task = self._task, None
        if task is not None:
            task.cancel()
            await asyncio.wait([task])

    async def _run(self) -> None:
        pause_s = 1.0
        while True:
            try:
                await self._listen()
                pause_s = 1.0
            except (OSError, TimeoutError, WebSocketException, InvalidHandshake, InvalidURI) as why:
                _log.debug("no push from the OpenEVSE: %s", why)
                pause_s = min(2.0 * pause_s, LONGEST_PAUSE_S)
            finally:
                self.connected.clear()
            await asyncio.sleep(pause_s)

    async def _listen(self) -> None:
        settings = self._settings
        headers = {}
        if settings.password is not None:
            login = f"{settings.user}:{settings.password.get_secret_value()}".encode()
            headers["Authorization"] = "Basic " + base64.b64encode(login).decode()
        async with websockets.asyncio.client.connect(
            "ws" + settings.url.removeprefix("http") + "/ws",
            additional_headers=headers,
            open_timeout=settings.timeout_s,
            close_timeout=settings.timeout_s,
            max_size=65536,
            proxy=None,
        ) as socket:
            self.connected.set()
            async for message in socket:
                self._take(message)

    def _take(self, message: str | bytes) -> None:
        try:
            pushed = Pushed.model_validate_json(message)
        except ValidationError:
            _log.debug("the OpenEVSE pushed something that makes no sense")
            return
        if pushed.shows_load:
            self.load_seen_s = asyncio.get_running_loop().time()
        # It repeats its time and its temperatures every second: they are no news.
        if pushed not in (Pushed(), self._newest):
            self._newest = pushed
            for listener in self._listeners:
                listener()
