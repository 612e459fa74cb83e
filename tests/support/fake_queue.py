"""The queue of a fake board: follows segments and brakes, exactly as the protocol describes it."""

from __future__ import annotations

from collections import deque
from dataclasses import replace

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import TICK_HZ, Refusal
from drivers.arduino.steps import Triple, WirePoint, phase, point_after, segment_end, whole

BRAKE_TICKS = TICK_HZ // 50
HALF_UNIT = 1 << 30
STILL: Triple = (0, 0, 0)


def centred(units: Triple) -> Triple:
    """The middle of some units."""
    one, two, three = ((u << 31) + HALF_UNIT for u in units)
    return one, two, three


def whole_units(position: Triple) -> Triple:
    """The units of a position, rounded down."""
    one, two, three = map(whole, position)
    return one, two, three


def phases(position: Triple) -> Triple:
    """What is left of a position beside its units."""
    one, two, three = map(phase, position)
    return one, two, three


class FakeQueue:
    """Segments, a brake, and where they lead."""

    def __init__(self) -> None:
        self.position = centred((0, 0, 0))
        self.begin_session()

    def begin_session(self) -> None:
        """Count segments from 0 again."""
        self.next_number = 0
        self.segments: deque[messages.Segment] = deque()
        self._brake: messages.Segment | None = None
        self._start_tick = 0

    @property
    def running(self) -> messages.Segment | None:
        """The segment being followed, or the brake."""
        return self._brake or (self.segments[0] if self.segments else None)

    @property
    def braking(self) -> bool:
        """A stop is under way."""
        return self._brake is not None

    def ticks_done(self, tick: int) -> int:
        """Ticks of the running segment that are done."""
        return tick - self._start_tick if self.segments else 0

    def point(self, tick: int) -> WirePoint:
        """Where the set points are."""
        if self.running is None:
            return WirePoint(self.position, STILL)
        return point_after(self.running, tick - self._start_tick)

    def follow(self, tick: int) -> WirePoint | None:
        """Live until a tick; if all has been followed by then, return how it ended."""
        while (running := self.running) is not None and tick - self._start_tick >= running.ticks:
            end = segment_end(running)
            self.position = end.position
            self._start_tick += running.ticks
            if self._brake is not None:
                self._brake = None
                self.position = centred(whole_units(self.position))
                return WirePoint(self.position, STILL)
            self.segments.popleft()
            if not self.segments:
                return end
        return None

    def brake(self, tick: int) -> None:
        """Drop everything and decelerate, unless that is under way."""
        if self.running is not None and self._brake is None:
            point = self.point(tick)
            one, two, three = (-round(rate / BRAKE_TICKS) for rate in point.rate)
            self._brake = messages.Segment(
                number=0,
                ticks=BRAKE_TICKS,
                start=whole_units(point.position),
                phase=phases(point.position),
                rate=point.rate,
                acceleration=(one, two, three),
            )
            self._start_tick = tick
        self.segments.clear()

    def append(self, segment: messages.Segment, tick: int, axis: messages.ConfigAxis) -> Refusal:
        """Take a segment or refuse it, by the limits of one axis for all."""
        moving = bool(self.segments)
        end = segment_end(self.segments[-1]) if moving else WirePoint(self.position, STILL)
        reached = segment_end(segment)
        if len(self.segments) >= messages.QUEUE_CAPACITY:
            return Refusal.QUEUE_FULL
        if segment.number != self.next_number:
            return Refusal.WRONG_NUMBER
        if segment.start != whole_units(end.position):
            return Refusal.DISCONTINUOUS
        if moving and segment.phase != phases(end.position):
            return Refusal.DISCONTINUOUS
        if any(
            abs(a - b) > axis.max_rate_jump for a, b in zip(segment.rate, end.rate, strict=True)
        ):
            return Refusal.RATE_JUMP
        if max(map(abs, (*segment.rate, *reached.rate))) > axis.max_rate:
            return Refusal.TOO_FAST
        if not moving:
            self._start_tick = tick
        self.segments.append(segment)
        self.next_number = (segment.number + 1) % (1 << 16)
        return Refusal.NONE

    def place(self, units: Triple) -> None:
        """Put the axes somewhere else."""
        self.position = centred(units)

    def slip(self, steps: Triple) -> None:
        """Lose steps: the axes are no longer where the segments lead."""

        def moved(start: Triple) -> Triple:
            one, two, three = (a + b for a, b in zip(start, steps, strict=True))
            return one, two, three

        self.segments = deque(replace(s, start=moved(s.start)) for s in self.segments)
