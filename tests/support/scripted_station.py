"""A station that says what a test tells it to say, at once or never."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from drivers.station import (
    PilotState,
    StationCapabilities,
    StationError,
    StationSilentError,
    StationSnapshot,
)

SAFE = StationSnapshot(
    sampled_at_s=0.0,
    pilot=PilotState.B,
    enabled=False,
    held=True,
    contactor_closed=False,
    connector_locked=False,
    power_w=0.0,
    currents_a=(0.0, 0.0, 0.0),
    session_energy_wh=0.0,
)


class ScriptedStation:
    """Implements StationDriver; the fields of its readings are set by the test.

    Attributes:
        says: Fields that differ from a station without load.
        failure: Raised instead of a reading.
        silent: No answer ever comes.
        answers: Readings given so far.
        age_s: How old its readings are.
    """

    name = "Scripted station"

    def __init__(self) -> None:
        self.capabilities = StationCapabilities(switches=True, holds=True, unlocks=True)
        self.says: dict[str, Any] = {}
        self.failure: StationError | None = None
        self.silent = False
        self.answers = 0
        self.age_s = 0.0

    async def snapshot(self) -> StationSnapshot:
        asked_s = asyncio.get_running_loop().time()
        await asyncio.sleep(0.02)
        if self.silent:
            await asyncio.sleep(3.0)
            raise StationSilentError("no answer")
        if self.failure is not None:
            raise self.failure
        self.answers += 1
        return replace(SAFE, **{"sampled_at_s": asked_s - self.age_s, **self.says})

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    async def start(self) -> None: ...

    async def stop(self) -> None: ...

    async def hold(self) -> None: ...

    async def release(self) -> None: ...

    async def unlock(self) -> None: ...

    async def limit_current(self, current_a: float) -> None: ...

    def listen(self, listener: Callable[[], None]) -> None: ...
