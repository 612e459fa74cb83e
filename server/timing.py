"""Event loops whose clock is not the wall clock.

Everything that decides or moves takes its time from the running event loop, so choosing the loop
chooses how time passes:

- a normal loop for a real robot,
- ``ScaledTimeLoop`` to run the simulator faster (or slower) than real time in a browser,
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


class _SkippingSelector(_DelegatingSelector):
    """Instead of waiting for a timeout, moves the clock on by it."""

    def __init__(self) -> None:
        super().__init__()
        self.now_s = 0.0

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        ready = super().select(0)
        if ready or timeout == 0:
            return ready
        if timeout is None:
            raise NothingLeftToWaitForError(
                "all tasks wait, and no timer is set that could wake one"
            )
        self.now_s += timeout
        return []


class VirtualTimeLoop(asyncio.SelectorEventLoop):
    """An event loop that skips every wait: its clock starts at 0 and jumps to the next timer.

    Work given to executors (``asyncio.to_thread``) runs at once, in order, so a run depends on
    nothing but its inputs. Sockets are only polled: do not use it for network traffic.
    """

    def __init__(self) -> None:
        self._skipping = _SkippingSelector()
        super().__init__(self._skipping)

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
    """Waits for ``timeout`` seconds of the scaled clock."""

    def __init__(self, speed: float) -> None:
        super().__init__()
        self._speed = speed

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        return super().select(None if timeout is None else timeout / self._speed)


class ScaledTimeLoop(asyncio.SelectorEventLoop):
    """An event loop whose clock runs ``speed`` times as fast as the wall clock."""

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self._origin_s = time.monotonic()
        super().__init__(_ScaledSelector(speed))

    def time(self) -> float:
        """Scaled time since the loop was made [s]."""
        return (time.monotonic() - self._origin_s) * self._speed


class Calendar:
    """Turns event loop times into dates.

    Args:
        speed: Seconds of the loop per second of the wall clock; dates stay wall-clock dates.
        loop: The loop; the running one by default.
    """

    def __init__(self, speed: float = 1.0, loop: asyncio.AbstractEventLoop | None = None) -> None:
        self._loop = loop or asyncio.get_running_loop()
        self._speed = speed
        self._origin_s = self._loop.time()
        self._origin = datetime.now(UTC)

    def now(self) -> datetime:
        """The date now."""
        return self.at(self._loop.time())

    def at(self, loop_time_s: float) -> datetime:
        """The date at an event loop time."""
        return self._origin + timedelta(seconds=(loop_time_s - self._origin_s) / self._speed)
