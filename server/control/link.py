"""Keeps the link to the motion board alive and feeds the telemetry."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable

from drivers.robot import RobotDriver, RobotDriverError, RobotIdentity, RobotState, StopCategory
from server.control.telemetry import Telemetry

_log = logging.getLogger(__name__)

RECONNECT_S = 1.0

OnSample = Callable[[RobotState], Awaitable[None]]


class RobotLink:
    """Connects for ever; every sample goes into the telemetry, then to the listeners.

    Args:
        driver: The motion board.
        telemetry: Fed with every sample, emptied when the link goes down.
        seen: A sample as everybody else sees it.
        on_connected: Called with the first sample after every connection.
        on_sample: Called with every sample.
        on_lost: Called when the link goes down.

    Attributes:
        identity: What answered last, None before anything did.
        trouble: Why there is no link; None while there is one.
        newest: The newest sample as the board gave it, None while there is no link.
    """

    def __init__(
        self,
        driver: RobotDriver,
        telemetry: Telemetry,
        *,
        seen: Callable[[RobotState], RobotState],
        on_connected: OnSample,
        on_sample: OnSample,
        on_lost: Callable[[], None],
    ) -> None:
        self.identity: RobotIdentity | None = None
        self.trouble: RobotDriverError | None = None
        self.newest: RobotState | None = None
        self._driver = driver
        self._telemetry = telemetry
        self._seen = seen
        self._on_connected = on_connected
        self._on_sample = on_sample
        self._on_lost = on_lost
        self._task: asyncio.Task[None] | None = None
        self._attempted = asyncio.Event()

    async def start(self, *, wait: bool = True) -> None:
        """Begin connecting.

        Args:
            wait: Return only after the first attempt, whether it worked or not.
        """
        self._task = asyncio.create_task(self._run(), name="robot link")
        if wait:
            await self._attempted.wait()

    async def close(self) -> None:
        """Stop the robot and let go of it; whoever waits for telemetry learns that it ended."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait([self._task])
        self._lose()
        await self._driver.close()

    def see_anew(self) -> None:
        """Samples are seen differently from now on."""
        if self.newest is not None:
            self._telemetry.begin_anew(self._seen(self.newest))

    async def _run(self) -> None:
        while True:
            try:
                self.identity = await self._driver.connect()
                self.trouble = None
                await self._read()
            except RobotDriverError as error:
                self._note(error)
            except Exception:  # noqa: BLE001 - such as a full disk; it is logged
                # Without anybody who watches it, the robot must stand still.
                _log.exception("the link to the motion board broke down; connecting anew")
                await self._stop_unwatched()
            self._lose()
            self._attempted.set()
            await asyncio.sleep(RECONNECT_S)

    async def _read(self) -> None:
        first = True
        async for sample in self._driver.telemetry():
            self.newest, state = sample, self._seen(sample)
            self._telemetry.put(state)
            if first:
                await self._on_connected(state)
                self._attempted.set()
                first = False
            await self._on_sample(state)

    def _note(self, trouble: RobotDriverError) -> None:
        """Log what is wrong once, not at every attempt."""
        if str(trouble) != str(self.trouble):
            _log.warning("no link to the motion board: %s", trouble)
        self.trouble = trouble

    async def _stop_unwatched(self) -> None:
        try:
            await self._driver.stop(StopCategory.DECELERATE_AND_HOLD)
        except RobotDriverError as error:
            _log.warning("the stop did not reach the motion board: %s", error)

    def _lose(self) -> None:
        self.newest = None
        self._telemetry.lose()
        self._on_lost()
