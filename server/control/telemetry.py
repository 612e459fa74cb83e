"""The newest state of the robot, a little of its past, and a way to wait for the next one."""

from __future__ import annotations

import asyncio
from collections import deque

from drivers.robot import RobotState
from server.control.errors import RobotOfflineError
from twin.joints import JointPosition

HISTORY_S = 2.0


class Telemetry:
    """Fed with every sample by the supervisor; read by everyone else."""

    def __init__(self) -> None:
        self._history: deque[RobotState] = deque()
        self._next: asyncio.Future[RobotState] | None = None

    @property
    def latest(self) -> RobotState | None:
        """The newest sample, or None while the link is down."""
        return self._history[-1] if self._history else None

    @property
    def rate_hz(self) -> float | None:
        """Samples per second in the last HISTORY_S; None before there are two."""
        if len(self._history) < 2:
            return None
        span_s = self._history[-1].sampled_at_s - self._history[0].sampled_at_s
        return (len(self._history) - 1) / span_s if span_s > 0 else None

    def require(self) -> RobotState:
        """The newest sample.

        Raises:
            RobotOfflineError: the link is down.
        """
        if not self._history:
            raise RobotOfflineError("The motion board does not answer.")
        return self._history[-1]

    def put(self, state: RobotState) -> None:
        """Take in a sample."""
        self._history.append(state)
        while state.sampled_at_s - self._history[0].sampled_at_s > HISTORY_S:
            self._history.popleft()
        waiting, self._next = self._next, None
        if waiting is not None and not waiting.done():
            waiting.set_result(state)

    def begin_anew(self, state: RobotState) -> None:
        """Joints count differently from this sample on: forget the older ones."""
        self._history.clear()
        self.put(state)

    def lose(self) -> None:
        """The link went down: forget everything and tell whoever waits."""
        self._history.clear()
        waiting, self._next = self._next, None
        if waiting is not None and not waiting.done():
            waiting.set_exception(RobotOfflineError("The link to the motion board was lost."))
            waiting.exception()  # nobody need wait; an unretrieved exception would only be noise

    async def next(self) -> RobotState:
        """Wait for the next sample.

        Raises:
            RobotOfflineError: the link is down or goes down.
        """
        if not self._history:
            raise RobotOfflineError("The motion board does not answer.")
        if self._next is None:
            self._next = asyncio.get_running_loop().create_future()
        return await asyncio.shield(self._next)

    async def newer_than(self, known: RobotState) -> RobotState:
        """The newest sample, as soon as it is another one than ``known``.

        Raises:
            RobotOfflineError: the link is down or goes down.
        """
        state = self.require()
        return state if state is not known else await self.next()

    def after(self, known: RobotState) -> list[RobotState]:
        """All samples since ``known``, oldest first; the newest alone if that is forgotten."""
        newer: list[RobotState] = []
        for state in reversed(self._history):
            if state is known:
                return newer[::-1]
            newer.append(state)
        return newer[:1]

    async def reach(self, time_s: float) -> RobotState:
        """Wait for a sample taken at or after ``time_s`` (event loop time).

        Raises:
            RobotOfflineError: the link is down or goes down.
        """
        state = self.require()
        while state.sampled_at_s < time_s:
            state = await self.next()
        return state

    def joints_at(self, time_s: float) -> JointPosition:
        """Measured joints at an instant of the last seconds, interpolated between samples [mm].

        Before the oldest sample and after the newest one the nearest sample is returned.

        Raises:
            RobotOfflineError: the link is down.
        """
        newest = self.require()
        if time_s >= newest.sampled_at_s:
            return newest.measured.position
        later = newest
        for state in reversed(self._history):
            if state.sampled_at_s <= time_s:
                span_s = later.sampled_at_s - state.sampled_at_s
                share = (time_s - state.sampled_at_s) / span_s if span_s > 0 else 0.0
                return JointPosition(
                    *(
                        a + share * (b - a)
                        for a, b in zip(
                            state.measured.position, later.measured.position, strict=True
                        )
                    )
                )
            later = state
        return later.measured.position
