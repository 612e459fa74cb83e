"""An event loop whose time is the simulated board's."""

from __future__ import annotations

from typing import Protocol

from server.timing import VirtualTimeLoop, skip_time

LONGEST_WAIT_S = 1.0
"""Time passes at most this far at once while no timer is set."""


class World(Protocol):
    """Something that lives in the time of a loop."""

    def live(self, until_s: float) -> float:
        """Live until then, or until something has happened; returns the time it has become."""
        ...


class LockStepLoop(VirtualTimeLoop):
    """When all tasks wait, lets a world live until the next timer, or until it says something.

    Callbacks take no time. Without a world it skips the waits.
    """

    def __init__(self) -> None:
        self._world: World | None = None
        super().__init__(self._pass_time)

    def join(self, world: World) -> None:
        """Live in step with a world from now on."""
        assert self._world is None, "a loop can keep step with one world only"
        self._world = world

    def leave(self) -> None:
        """Live alone again."""
        self._world = None

    def stall(self, duration_s: float) -> None:
        """Be busy with something else: the world goes on, its news wait."""
        until_s = self.time() + duration_s
        while self.time() < until_s:
            self._skipping.now_s = self._pass_time(self.time(), until_s)

    def _pass_time(self, now_s: float, until_s: float | None) -> float:
        if self._world is None:
            return skip_time(now_s, until_s)
        return max(now_s, self._world.live(now_s + LONGEST_WAIT_S if until_s is None else until_s))
