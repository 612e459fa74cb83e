"""A driver who parks a simulated car by what the guidance says."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field

from drivers.simulator.traffic import Arrival, Traffic
from server.guidance.advice import Advice
from server.guidance.guide import Guide
from server.guidance.model import Direction, GuidanceState
from tests.support.garage import Scene

LOOK_S = 0.1
LEAST_CORRECTION_MM = 4.0


@dataclass
class Parking:
    """One car on its way in, and all that was said to its driver.

    Attributes:
        scene: The garage with a parked robot.
        said: Every new state with its headline, in order.
    """

    scene: Scene
    said: list[tuple[GuidanceState, str]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.guide.listen(self._hear)

    @property
    def guide(self) -> Guide:
        return self.scene.services.guide

    @property
    def traffic(self) -> Traffic:
        assert self.scene.services.simulated_car is not None
        return self.scene.services.simulated_car.traffic

    @property
    def advice(self) -> Advice:
        return self.guide.now.advice

    def arriving(self) -> bool:
        """Whether the page would show itself."""
        return self.guide.now.arriving

    def looked_at_s(self) -> float | None:
        """When the newest picture was taken."""
        return self.guide.now.looked_at_s

    @property
    def states(self) -> list[GuidanceState]:
        """Every state in the order in which it was said."""
        states = [state for state, _ in self.said]
        return [s for i, s in enumerate(states) if i == 0 or s is not states[i - 1]]

    async def watch(self, seconds: float) -> None:
        """Somebody keeps looking at the page for so long."""
        until_s = self.scene.now_s + seconds
        while self.scene.now_s < until_s:
            self.guide.ask()
            await asyncio.sleep(LOOK_S)

    async def until(self, *states: GuidanceState, within_s: float = 40.0) -> Advice:
        """Look until one of these is said."""
        until_s = self.scene.now_s + within_s
        while self.advice.state not in states:
            assert self.scene.now_s < until_s, f"said {self.said}, never {states}"
            self.guide.ask()
            await asyncio.sleep(LOOK_S)
        return self.advice

    def arrive(self, **how: float) -> None:
        self.traffic.arrive(Arrival(**how), self.scene.now_s)

    async def obey(self, reaction_s: float = 0.6, corrections: int = 6) -> Advice:
        """Drive as told: brake when told to, then correct to and fro until it is enough."""
        await self.until(GuidanceState.STOP, GuidanceState.SKEWED, GuidanceState.LOST)
        await self.watch(reaction_s)
        self.traffic.brake(self.scene.now_s)
        for _ in range(corrections):
            await self.watch(2.5)
            forward_mm = sum(
                (step.direction is Direction.FORWARD) * step.distance_mm
                - (step.direction is Direction.BACK) * step.distance_mm
                for step in self.advice.steps
            )
            if abs(forward_mm) < LEAST_CORRECTION_MM:
                break
            self.traffic.creep(forward_mm, self.scene.now_s)
            await self.watch(2.0)
        return self.advice

    def _hear(self) -> None:
        advice = self.advice
        words = (advice.state, advice.words.headline)
        if not self.said or self.said[-1] != words:
            self.said.append(words)
