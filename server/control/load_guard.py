"""Nobody moves the plug in a socket without a proof that no current flows.

The proof is two new readings of the station in a row, and it holds only as long as the station
goes on being read: the first sign of load, a fault of the reading or silence end it, and whatever
moves is stopped at once. This is the one place where that is decided; jobs, a technician's jog
steps and homing all come through it.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Callable

from drivers.station import StationDriver, StationError, StationSnapshot
from server.config.supervision import SupervisionSettings
from server.control.errors import ControlError, StationUnsafeError
from server.control.load_rule import why_not_safe

_log = logging.getLogger(__name__)

READINGS_NEEDED = 2

OnAlarm = Callable[[ControlError], None]


class LoadGuard:
    """Proves that no current flows, and watches that it stays so.

    Args:
        station: The charging station.
        settings: How often it is read, and what counts as new.

    Attributes:
        on_alarm: Called at once with the reason when a proof ends.
    """

    def __init__(self, station: StationDriver, settings: SupervisionSettings) -> None:
        self.on_alarm: OnAlarm = lambda _: None
        self._station = station
        self._settings = settings
        self._watchers = 0
        self._watch: asyncio.Task[None] | None = None
        self._newest_s: float | None = None
        self._alarm: ControlError | None = None

    @property
    def alarm(self) -> ControlError | None:
        """Why the last proof has ended; None while it holds."""
        return self._alarm

    def require(self) -> None:
        """Do nothing while the proof holds.

        Raises:
            StillUnderLoadError: current flows, or may at any moment.
            StationUnsafeError: nobody knows.
        """
        if self._alarm is not None:
            raise self._alarm
        if self._newest_s is None:
            raise StationUnsafeError(
                "The plug may be in a socket, and nobody has made sure that no current flows."
            )
        if self._age_s() > self._settings.station_age_s:
            raise _silent(self._age_s())

    async def prove(self, patience_s: float = 0.0) -> None:
        """Read the station until two new readings in a row show that no current flows.

        Only readings taken after the call count, so give all commands before.

        Args:
            patience_s: What speaks against it may take so long to pass.

        Raises:
            StillUnderLoadError: current flows, or may at any moment.
            StationUnsafeError: nobody knows.
        """
        loop = asyncio.get_running_loop()
        began_s = last_s = loop.time()
        safe_in_a_row = 0
        while True:
            problem, sampled_at_s = await self._read(not_before_s=began_s)
            if problem is None and (sampled_at_s > last_s or safe_in_a_row == 0):
                safe_in_a_row, last_s = safe_in_a_row + 1, sampled_at_s
            elif problem is not None:
                safe_in_a_row = 0
                # One lost answer is no silence yet.
                lost = isinstance(problem, _NoAnswerError)
                allowed_s = max(patience_s, self._settings.station_age_s if lost else 0.0)
                if loop.time() - began_s >= allowed_s:
                    raise problem
            if safe_in_a_row >= READINGS_NEEDED:
                return
            await asyncio.sleep(self._settings.station_sample_s)

    @contextlib.asynccontextmanager
    async def watching(self, patience_s: float = 0.0) -> AsyncIterator[None]:
        """No current flows in this block, or ``require`` raises and ``on_alarm`` is called.

        Args:
            patience_s: See ``prove``.

        Raises:
            StillUnderLoadError: current flows, or may at any moment.
            StationUnsafeError: nobody knows.
        """
        if self._watchers == 0:
            self._alarm = None
            self._newest_s = None
            await self.prove(patience_s)
            self._newest_s = asyncio.get_running_loop().time()
            self._watch = asyncio.create_task(self._keep_watching(), name="station watch")
        self.require()
        self._watchers += 1
        try:
            yield
        finally:
            self._watchers -= 1
            if self._watchers == 0:
                await self._stop_watching()

    async def _stop_watching(self) -> None:
        watch, self._watch = self._watch, None
        self._newest_s = None
        if watch is not None:
            watch.cancel()
            await asyncio.wait([watch])

    async def _keep_watching(self) -> None:
        """Ends with an alarm, whatever happens to it: nobody pulls without a watch."""
        try:
            alarm = await self._first_sign_of_danger()
        except Exception:  # noqa: BLE001 - logged; whatever it is, the plug must not move
            _log.exception("the watch over the charging station failed")
            alarm = StationUnsafeError(
                "The watch over the charging station failed. The log has the details."
            )
        self._alarm = alarm
        self.on_alarm(alarm)

    async def _first_sign_of_danger(self) -> ControlError:
        loop = asyncio.get_running_loop()
        due_s = loop.time()
        while True:
            due_s = max(due_s + self._settings.station_sample_s, loop.time())
            await asyncio.sleep(due_s - loop.time())
            problem, sampled_at_s = await self._read(not_before_s=-1.0)
            if problem is None:
                self._newest_s = max(sampled_at_s, self._newest_s or sampled_at_s)
            elif not isinstance(problem, _NoAnswerError):
                return problem
            if self._age_s() >= self._settings.station_age_s:
                return problem or _silent(self._age_s())

    async def _read(self, *, not_before_s: float) -> tuple[ControlError | None, float]:
        """One reading: what it has against moving the plug, and when it was taken."""
        loop = asyncio.get_running_loop()
        age_limit_s = self._settings.station_age_s
        # Half of the time, so that one lost answer leaves room for another question.
        wait_s = min(0.5 * age_limit_s, max(age_limit_s - self._age_s(), 0.0))
        if self._newest_s is None:
            wait_s = 0.5 * age_limit_s
        try:
            async with asyncio.timeout(wait_s):
                snapshot: StationSnapshot = await self._station.snapshot()
        except TimeoutError:
            return _NoAnswerError("The charging station has fallen silent."), loop.time()
        except StationError as error:
            return _NoAnswerError(str(error) or "The charging station does not answer."), 0.0
        problem = why_not_safe(
            snapshot, self._station.capabilities, loop.time(), age_limit_s=age_limit_s
        )
        if problem is None and snapshot.sampled_at_s < not_before_s:
            return _silent(loop.time() - snapshot.sampled_at_s), snapshot.sampled_at_s
        return problem, snapshot.sampled_at_s

    def _age_s(self) -> float:
        newest_s = self._newest_s
        return float("inf") if newest_s is None else asyncio.get_running_loop().time() - newest_s


class _NoAnswerError(StationUnsafeError):
    """One lost answer; only several in a row are an alarm."""


def _silent(age_s: float) -> StationUnsafeError:
    return StationUnsafeError(
        f"The newest reading of the charging station is {age_s:.1f} s old.", age_s=round(age_s, 1)
    )
