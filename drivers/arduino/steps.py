"""Segments in the board's integers, and exactly where they lead.

The board adds: at each tick ``P += rate; rate += acceleration``. So after n ticks
``P(n) = P(0) + n rate + acceleration n (n - 1) / 2`` without any rounding, and the host knows every
step in advance. What a segment misses of its end by rounding, the next one makes good, because it
starts where the last one really ended.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import PHASE_BITS, TICK_HZ
from drivers.arduino.scale import ONE_UNIT, AxisScale
from twin.motion.segments import Segment

Triple = tuple[int, int, int]

ROUNDING_TICKS = 1e-4
"""A duration this little above a whole tick is that tick."""


def position_after(position: int, rate: int, acceleration: int, ticks: int) -> int:
    """Fixed-point position after some ticks."""
    return position + ticks * rate + acceleration * (ticks * (ticks - 1) // 2)


def rate_after(rate: int, acceleration: int, ticks: int) -> int:
    """Rate after some ticks."""
    return rate + ticks * acceleration


def whole(position: int) -> int:
    """Whole units of a position, rounded down as the board does."""
    return position >> PHASE_BITS


def phase(position: int) -> int:
    """What is left of a position beside its whole units."""
    return position & (ONE_UNIT - 1)


@dataclass(frozen=True, slots=True)
class WirePoint:
    """Fixed-point positions and rates of the three axes at one instant."""

    position: Triple
    rate: Triple


def point_after(segment: messages.Segment, ticks: int) -> WirePoint:
    """Where a segment is after some of its ticks."""
    starts = [(w << PHASE_BITS) + p for w, p in zip(segment.start, segment.phase, strict=True)]
    motion = list(zip(starts, segment.rate, segment.acceleration, strict=True))
    p1, p2, p3 = (position_after(start, rate, a, ticks) for start, rate, a in motion)
    r1, r2, r3 = (rate_after(rate, a, ticks) for _, rate, a in motion)
    return WirePoint((p1, p2, p3), (r1, r2, r3))


def segment_end(segment: messages.Segment) -> WirePoint:
    """Where a segment ends."""
    return point_after(segment, segment.ticks)


def ticks_of(duration_s: float) -> int:
    """Ticks of a duration, rounded up: never faster than planned, at most one tick slower."""
    return max(math.ceil(duration_s * TICK_HZ - ROUNDING_TICKS), 1)


def wire_segment(
    segment: Segment, number: int, start: Triple, scales: Sequence[AxisScale]
) -> messages.Segment:
    """A segment of a plan in the board's integers.

    It begins exactly at ``start``, which may differ from the plan's start by rounding, and ends
    where the plan wants it to within n/2 of 2^-31 units.

    Args:
        segment: Of the plan, in millimetres.
        number: It shall have.
        start: Fixed-point positions at which the queue ends.
        scales: Of the three axes.
    """
    ticks = ticks_of(segment.duration_s)
    rates: list[int] = []
    accelerations: list[int] = []
    for position, end_mm, acceleration_mm_s2, scale in zip(
        start, segment.end, segment.acceleration, scales, strict=True
    ):
        # the duration was rounded to ticks: keep the shape of the motion, not its speed
        per_tick2 = acceleration_mm_s2 * (segment.duration_s / ticks) ** 2
        acceleration = round(per_tick2 * scale.units_per_mm * ONE_UNIT)
        distance = scale.position(end_mm) - position
        rates.append(round((distance - acceleration * (ticks * (ticks - 1) // 2)) / ticks))
        accelerations.append(acceleration)
    return messages.Segment(
        number=number,
        ticks=ticks,
        start=(whole(start[0]), whole(start[1]), whole(start[2])),
        phase=(phase(start[0]), phase(start[1]), phase(start[2])),
        rate=(rates[0], rates[1], rates[2]),
        acceleration=(accelerations[0], accelerations[1], accelerations[2]),
    )


def nearest_within_unit(position: int, units: int) -> int:
    """The position nearest to a wanted one whose whole units are the given ones."""
    return min(max(position, units << PHASE_BITS), ((units + 1) << PHASE_BITS) - 1)
