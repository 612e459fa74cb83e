"""Sees what really happens between contactor and plug, and how soon the motion was stopped."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass, field

from drivers.simulator.garage import SimulatedGarage
from drivers.simulator.socket_contact import Place
from twin.motion.segments import Segment

MOVING_MM_S = 1.0
LOOK_S = 0.001
GIVE_UP_S = 5.0
BRAKING_S = 0.1
"""Longer than any braking takes, shorter than anybody needs to begin anew."""


@dataclass(frozen=True, slots=True)
class Danger:
    """The contactor closed, or the station was enabled, while the plug was moving in the socket.

    Attributes:
        depth_mm: Where the plug was.
        speed_mm_s: Of the slide, positive inwards.
        told_after_s: Until the board was told to stop; 0 when it was stopping already.
        still_after_s: Until the plug stood still.
        sample_s: One sample of this station: period, question and answer.
    """

    depth_mm: float
    speed_mm_s: float
    told_after_s: float
    still_after_s: float
    sample_s: float


@dataclass
class Witness:
    """Stands beside the simulated garage from now on.

    Args:
        garage: Where.
        sample_s: Longest time from one reading of the station to the end of the next.

    Attributes:
        closings: The contactor closed with the plug moving.
        enablings: The station was enabled with the plug moving and the pilot contact made.
        begun_under_load: Motions of the plug in the socket that began with a closed contactor.
        begun: All motions of the plug that began in the socket.
    """

    garage: SimulatedGarage
    sample_s: float
    closings: list[Danger] = field(default_factory=list)
    enablings: list[Danger] = field(default_factory=list)
    begun_under_load: int = 0
    begun: int = 0

    def __post_init__(self) -> None:
        self._told_at_s = -10.0
        self._looking: set[asyncio.Task[None]] = set()
        world, point = self.garage.world, self.garage.station.point
        follow, brake, enable = world.follow, world.brake, point.enable

        def witnessed_follow(segments: Sequence[Segment], now_s: float) -> None:
            if now_s >= world.line.rests_from_s and self._depth_mm() > 0.0:
                self.begun += 1
                self.begun_under_load += point.contactor_closed
            follow(segments, now_s)

        def witnessed_brake(now_s: float, *, rho3_mm: float | None = None) -> None:
            self._told_at_s = now_s
            brake(now_s, rho3_mm=rho3_mm)

        def witnessed_enable() -> None:
            was_enabled = point.enabled
            enable()
            if point.enabled and not was_enabled and point.connected:
                self._begin_look(self.enablings)

        world.follow = witnessed_follow  # type: ignore[method-assign]
        world.brake = witnessed_brake  # type: ignore[method-assign]
        point.enable = witnessed_enable  # type: ignore[method-assign]
        point.on_contactor = self._contactor

    async def done(self) -> None:
        """Wait until all that was begun has been seen to its end."""
        while self._looking:
            await asyncio.wait(self._looking)

    def _contactor(self, closed: bool) -> None:
        if closed:
            self._begin_look(self.closings)

    def _begin_look(self, dangers: list[Danger]) -> None:
        if self._moves() and self._depth_mm() > 0.0:
            task = asyncio.create_task(self._look(dangers))
            self._looking.add(task)
            task.add_done_callback(self._looking.discard)

    async def _look(self, dangers: list[Danger]) -> None:
        loop = asyncio.get_running_loop()
        closed_s, speed_mm_s, depth_mm = loop.time(), self._speed_mm_s(), self._depth_mm()
        stopping = 0.0 <= closed_s - self._told_at_s < BRAKING_S
        give_up_s = closed_s + GIVE_UP_S
        while self._moves() and loop.time() < give_up_s:  # noqa: ASYNC110 - virtual time
            await asyncio.sleep(LOOK_S)
        still_s = loop.time() - closed_s
        told_s = still_s
        if stopping:
            told_s = 0.0
        elif self._told_at_s >= closed_s:
            told_s = min(self._told_at_s - closed_s, still_s)
        dangers.append(Danger(depth_mm, speed_mm_s, told_s, still_s, self.sample_s))

    def _moves(self) -> bool:
        return abs(self._speed_mm_s()) > MOVING_MM_S

    def _speed_mm_s(self) -> float:
        return self.garage.world.advance(self._now()).velocity.rho3_mm_s

    def _depth_mm(self) -> float:
        contact = self.garage.world.advance(self._now()).contact
        return contact.depth_mm if contact.place is Place.IN_SOCKET else -1.0

    @staticmethod
    def _now() -> float:
        return asyncio.get_running_loop().time()
