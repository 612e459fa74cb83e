"""A person says where the plug is, and the charging station must not see the opposite."""

from __future__ import annotations

import asyncio

from drivers.station import PilotState, StationDriver, StationError
from server.config.supervision import SupervisionSettings
from server.control.errors import (
    LateralMotionForbiddenError,
    PlugNotSeenError,
    PlugSeenInCarError,
)
from server.control.model import PlugState
from server.control.plug_guard import HELD, PlugGuard

CAR_SEEN = {PilotState.B, PilotState.C, PilotState.D}


class PlugWitness:
    """Compares what a person says of the plug with the control pilot.

    A station that is silent, out of order, or cannot sense a car says nothing, and then the
    person's word counts.

    Args:
        plug: Keeps the record.
        station: Whose pilot contact closes when the plug is fully in a car.
        settings: How old a reading may be.
    """

    def __init__(
        self, plug: PlugGuard, station: StationDriver, settings: SupervisionSettings
    ) -> None:
        self._plug = plug
        self._station = station
        self._settings = settings

    async def take_answer(self, answer: PlugState) -> None:
        """Write down where a person has seen the plug.

        A plug that is said to be in a car is at an unknown place from now on, whatever the station
        sees: only the way out along the axis is left.

        Args:
            answer: FREE or INSERTED.

        Raises:
            LateralMotionForbiddenError: it is said to be free, and was measured in the socket.
            PlugSeenInCarError: it is said to be free, and the station sees a car.
            PlugNotSeenError: it is said to be in a car, and the station sees none.
        """
        if answer is PlugState.INSERTED:
            if self._plug.state not in HELD:
                await self._plug.doubt()
            await self._compare_inserted()
            return
        if self._plug.state is PlugState.INSERTED:
            raise LateralMotionForbiddenError(
                "The plug is in the socket by PlugPilot's own measurement.", plug="inserted"
            )
        if self._plug.state is PlugState.UNKNOWN:
            await self._compare_free()
            await self._plug.is_free()

    async def _compare_free(self) -> None:
        pilot = await self._pilot()
        if pilot in CAR_SEEN:
            raise PlugSeenInCarError(
                "You say that the plug hangs free, but the charging station sees it in a car "
                f"(state {pilot.value}).",
                pilot=pilot.value,
            )

    async def _compare_inserted(self) -> None:
        if await self._pilot() is PilotState.A:
            raise PlugNotSeenError(
                "You say that the plug is in the car, but the charging station sees no car "
                "(state A).",
                pilot=PilotState.A.value,
            )

    async def _pilot(self) -> PilotState | None:
        """What the station sees now; None when it cannot say."""
        capabilities = self._station.capabilities
        if not (capabilities.senses_car and capabilities.fresh):
            return None
        try:
            async with asyncio.timeout(capabilities.reads_within_s):
                snapshot = await self._station.snapshot()
        except (TimeoutError, StationError):
            return None
        age_s = asyncio.get_running_loop().time() - snapshot.sampled_at_s
        return snapshot.pilot if age_s <= self._settings.station_age_s else None
