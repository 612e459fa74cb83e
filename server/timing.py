"""Event loops whose clock is not the wall clock.

Everything that decides or moves takes its time from the running event loop, so choosing the loop
chooses how time passes:

- a normal loop for a real robot,
- ``ScaledTimeLoop`` for the simulator in a browser, at any speed the machine can keep up with,
- ``VirtualTimeLoop`` to run a whole job in the time its computation takes.
"""

from __future__ import annotations

import asyncio
import selectors
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Any, TypeVarTuple

if TYPE_CHECKING:
    from _typeshed import FileDescriptorLike

Ts = TypeVarTuple("Ts")

MAX_LAG_S = 0.25
"""Scaled time that a clock may be behind and still make up for."""

MAX_DRIFT = timedelta(milliseconds=100)
"""Dates and the wall clock may differ by this much."""

PassTime = Callable[[float, float | None], float]
"""Lets time pass from now until a timer, or without an end, and returns the time it has become."""


class NothingLeftToWaitForError(RuntimeError):
    """Every task of a virtual-time loop waits for something that can never happen."""


class _DelegatingSelector(selectors.BaseSelector):
    """A selector that hands everything but ``select`` to the system's own."""

    def __init__(self) -> None:
        self._system = selectors.DefaultSelector()

    def register(
        self, fileobj: FileDescriptorLike, events: int, data: object = None
    ) -> selectors.SelectorKey:
        return self._system.register(fileobj, events, data)

    def unregister(self, fileobj: FileDescriptorLike) -> selectors.SelectorKey:
        return self._system.unregister(fileobj)

    def get_map(self) -> Mapping[Any, selectors.SelectorKey]:
        return self._system.get_map()

    def close(self) -> None:
        self._system.close()

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        return self._system.select(timeout)


def skip_time(now_s: float, until_s: float | None) -> float:  # noqa: ARG001 - a PassTime
    """Nothing happens in between.

    Raises:
        NothingLeftToWaitForError: there is no timer.
    """
    if until_s is None:
        raise NothingLeftToWaitForError("all tasks wait, and no timer is set that could wake one")
    return until_s


class _SkippingSelector(_DelegatingSelector):
    """Instead of waiting for a timeout, moves the clock on by it."""

    def __init__(self, pass_time: PassTime) -> None:
        super().__init__()
        self.now_s = 0.0
        self._pass_time = pass_time

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        ready = super().select(0)
        if ready or timeout == 0:
            return ready
        until_s = None if timeout is None else self.now_s + timeout
        self.now_s = self._pass_time(self.now_s, until_s)
        return []


class VirtualTimeLoop(asyncio.SelectorEventLoop):
    """An event loop that skips every wait: its clock starts at 0 and jumps to the next timer.

    Work given to executors (``asyncio.to_thread``) runs at once, in order, so a run depends on
    nothing but its inputs. Sockets are only polled: do not use it for network traffic.

    Args:
        pass_time: Called when all tasks wait; may return before the timer, when something has
            happened and was given to the loop (``call_soon``). By default nothing ever happens.
    """

    def __init__(self, pass_time: PassTime = skip_time) -> None:
        self._skipping = _SkippingSelector(pass_time)
        super().__init__(self._skipping)
        # How early asyncio may call a timer. Its default of 1 ns is lost in rounding once the
        # clock shows months: a timer that is due exactly now would never be.
        self._clock_resolution = 1e-6

    def time(self) -> float:
        """Virtual time since the loop was made [s]."""
        return self._skipping.now_s

    def run_in_executor(
        self,
        executor: Executor | None,  # noqa: ARG002 - the signature is asyncio's
        func: Callable[[*Ts], Any],
        *args: *Ts,
    ) -> asyncio.Future[Any]:
        """Run ``func`` now and return its result as a finished future."""
        future = self.create_future()
        try:
            future.set_result(func(*args))
        except Exception as error:  # noqa: BLE001 - handed to whoever awaits the future
            future.set_exception(error)
        return future


class _ScaledSelector(_DelegatingSelector):
    """Keeps a clock that runs ``speed`` times the wall clock, but never past the next timer.

    A timer therefore always runs at the time it was set for, however late the machine is. What
    the clock is behind it makes up by shorter waits; more than ``MAX_LAG_S`` it gives up.
    """

    def __init__(self, speed: float) -> None:
        super().__init__()
        self.now_s = 0.0
        self._speed = speed
        self._origin_s = time.monotonic()

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        if timeout is None:
            ready = super().select(None)
            self.now_s = max(self.now_s, self._target_s())
            return ready
        timer_s = self.now_s + timeout
        ready = super().select(max(0.0, (timer_s - self._target_s()) / self._speed))
        self.now_s = min(timer_s, max(self.now_s, self._target_s())) if ready else timer_s
        self._give_up_lag()
        return ready

    def _target_s(self) -> float:
        """Where the clock should be."""
        return (time.monotonic() - self._origin_s) * self._speed

    def _give_up_lag(self) -> None:
        lost_s = self._target_s() - self.now_s - MAX_LAG_S
        if lost_s > 0:
            self._origin_s += lost_s / self._speed


class ScaledTimeLoop(asyncio.SelectorEventLoop):
    """The event loop of a simulated garage: its clock runs ``speed`` times the wall clock.

    When the machine cannot keep up, time slows down instead of jumping: the simulated board
    shares the process with everything else, and would otherwise see an empty queue that no real
    board would have seen. The clock stands still during a callback.
    """

    def __init__(self, speed: float) -> None:
        self._scaled = _ScaledSelector(speed)
        super().__init__(self._scaled)

    def time(self) -> float:
        """Scaled time since the loop was made [s]."""
        return self._scaled.now_s


class Calendar:
    """Turns event loop times into dates.

    An instant keeps its date as long as the loop's clock keeps step with the wall clock. When the
    two have drifted apart, as they do when a simulated clock slows down, dates follow the wall.

    Args:
        speed: Seconds of the loop per second of the wall clock; dates stay wall-clock dates.
        loop: The loop; the running one by default.
    """

    def __init__(self, speed: float = 1.0, loop: asyncio.AbstractEventLoop | None = None) -> None:
        self._loop = loop or asyncio.get_running_loop()
        self._virtual = isinstance(self._loop, VirtualTimeLoop)
        # Virtual time has no wall clock beside it: its seconds are the seconds of its dates.
        self._speed = 1.0 if self._virtual else speed
        self._origin = datetime.now(UTC) - timedelta(seconds=self._loop.time() / self._speed)

    @property
    def speed(self) -> float:
        """Seconds of the loop per second of the dates."""
        return self._speed

    def now(self) -> datetime:
        """The date now."""
        return self.at(self._loop.time())

    def at(self, loop_time_s: float) -> datetime:
        """The date at an event loop time."""
        if not self._virtual:
            self._follow_the_wall()
        return self._origin + timedelta(seconds=loop_time_s / self._speed)

    def _follow_the_wall(self) -> None:
        drift = (
            datetime.now(UTC) - self._origin - timedelta(seconds=self._loop.time() / self._speed)
        )
        if abs(drift) > MAX_DRIFT:
            self._origin += drift
