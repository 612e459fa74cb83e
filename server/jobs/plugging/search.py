"""Where the plug tries again after it met an obstacle."""

from __future__ import annotations

from collections.abc import Iterator

from server.config.insertion import InsertionSettings
from server.jobs.approach import AT_THE_CENTRE, LateralOffset

AROUND = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (-1, -1))
"""Right, left, up, down, then the corners, in units of the radius."""


def further_tries(settings: InsertionSettings) -> Iterator[LateralOffset]:
    """Offsets of all tries after the first one, in order.

    The first of them aims at the newly measured centre: the car may have moved. The others stay
    on the square around it, small enough for what the plug holder and the socket's chamfer take
    up, so that a measurement that is off by a little more than that still leads into the socket.
    """
    radius_mm = settings.search_radius_mm
    offsets = [
        AT_THE_CENTRE,
        *(LateralOffset(x * radius_mm, y * radius_mm) for x, y in AROUND),
    ]
    yield from offsets[: settings.search_tries]
