"""One stream of samples for any number of readers."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncIterator
from typing import Self
from weakref import WeakSet

from drivers.robot.state import RobotState

KEPT_SAMPLES = 64
"""A reader that falls further behind loses the oldest samples."""


class TelemetryReader(AsyncIterator[RobotState]):
    """The samples from the moment it was made until the feed closes."""

    def __init__(self) -> None:
        self._samples: deque[RobotState] = deque(maxlen=KEPT_SAMPLES)
        self._changed = asyncio.Event()
        self._closed = False

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> RobotState:
        while not self._samples:
            if self._closed:
                raise StopAsyncIteration
            self._changed.clear()
            await self._changed.wait()
        return self._samples.popleft()

    def offer(self, sample: RobotState) -> None:
        """Hand over a sample."""
        self._samples.append(sample)
        self._changed.set()

    def close(self) -> None:
        """Nothing more will come."""
        self._closed = True
        self._changed.set()


class TelemetryFeed:
    """Hands every sample to all readers that are still alive."""

    def __init__(self) -> None:
        self._readers: WeakSet[TelemetryReader] = WeakSet()

    def subscribe(self) -> TelemetryReader:
        """A reader of all samples from now on; dropping it unsubscribes it."""
        reader = TelemetryReader()
        self._readers.add(reader)
        return reader

    def publish(self, sample: RobotState) -> None:
        """Hand a sample to all readers."""
        for reader in list(self._readers):
            reader.offer(sample)

    def close(self) -> None:
        """End the streams of all readers."""
        for reader in list(self._readers):
            reader.close()
        self._readers = WeakSet()
