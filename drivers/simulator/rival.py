"""Somebody else who commands the simulated station: an energy manager with a will of its own.

It sees the station at once and speaks with it without any delay, which is worse than any real one.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass

from drivers.simulator.charge_point import ChargePoint


@dataclass(frozen=True, slots=True)
class Will:
    """What it wants, and when.

    Attributes:
        after_s: It enables the station so long after it was let loose.
        again_after_s: It enables it once more so long after it found it off; None: once only.
        breaks_holds: It ends the hold of others first, as somebody at the station's own page can.
    """

    after_s: float
    again_after_s: float | None
    breaks_holds: bool


class Rival:
    """One such manager.

    Args:
        point: The hardware of the station.
        will: What it wants.
    """

    def __init__(self, point: ChargePoint, will: Will) -> None:
        self._point = point
        self._will = will
        self._task: asyncio.Task[None] | None = None
        self.enabled_at_s: list[float] = []

    def let_loose(self) -> None:
        """Begin."""
        self._task = asyncio.create_task(self._act(), name="rival")

    async def calm(self) -> None:
        """Leave the station alone from now on."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)

    async def _act(self) -> None:
        await asyncio.sleep(self._will.after_s)
        while True:
            if not self._point.enabled:
                self._enable()
            if self._will.again_after_s is None:
                return
            await asyncio.sleep(self._will.again_after_s)

    def _enable(self) -> None:
        if self._point.held and not self._will.breaks_holds:
            return
        if self._point.held:
            self._point.release()
        self._point.enable()
        self.enabled_at_s.append(asyncio.get_running_loop().time())
