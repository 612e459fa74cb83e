"""How old is what a station sends? It sends late what it could not send before."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime


class StationClock:
    """Compares the time stamps of one station with the moments when they arrive.

    The station gets its time from us, so both clocks agree within a tolerance. One that runs ahead
    is followed; one that was set back makes everything look old, which is the safe side.

    Args:
        tolerance_s: A difference up to this is no age.
    """

    def __init__(self, tolerance_s: float) -> None:
        self._tolerance_s = tolerance_s
        loop_s = asyncio.get_running_loop().time()
        # The calendar is read once, for the messages; time itself is the event loop's.
        self._ahead_at_first_s = datetime.now(UTC).timestamp() - loop_s
        self._ahead_s = self._ahead_at_first_s

    def now(self) -> datetime:
        """What we tell the station."""
        loop_s = asyncio.get_running_loop().time()
        return datetime.fromtimestamp(loop_s + self._ahead_at_first_s, UTC)

    def connected(self) -> None:
        """The station has connected anew, perhaps with another time."""
        self._ahead_s = self._ahead_at_first_s

    def sampled_s(self, stamp: str | None, arrived_s: float) -> float:
        """When a message was true, event loop time [s].

        Args:
            stamp: Its time stamp, ISO 8601; without one it was true when it arrived.
            arrived_s: When it arrived, event loop time [s].

        Raises:
            ValueError: the time stamp is none.
        """
        if stamp is None:
            return arrived_s
        moment = datetime.fromisoformat(stamp)
        if moment.tzinfo is None:
            moment = moment.replace(tzinfo=UTC)
        ahead_s = moment.timestamp() - arrived_s
        age_s = self._ahead_s - ahead_s
        self._ahead_s = max(self._ahead_s, ahead_s)
        return arrived_s if age_s <= self._tolerance_s else arrived_s - age_s
