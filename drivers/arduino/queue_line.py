"""The line of segments that the host has sent: it knows every step of it in advance."""

from __future__ import annotations

from collections import deque

from drivers.arduino.protocol import messages
from drivers.arduino.steps import Triple, WirePoint, point_after, segment_end, whole

NUMBERS = 1 << 16
"""Segments are counted modulo this."""

STILL: Triple = (0, 0, 0)


class QueueLine:
    """Segments from a known point at rest; unknown until ``begin`` and after ``forget``."""

    def __init__(self) -> None:
        self._segments: deque[messages.Segment] = deque()
        self._end: WirePoint | None = None
        self._first = 0
        self.next_number = 0

    @property
    def end(self) -> WirePoint | None:
        """Where the next segment must begin; None if that is not known."""
        return self._end

    def begin(self, position: Triple, number: int) -> None:
        """The board rests at a position and expects a segment with this number."""
        self._segments.clear()
        self._end = WirePoint(position, STILL)
        self._first = self.next_number = number

    def append(self, segment: messages.Segment) -> None:
        """A segment was sent; it begins at ``end``."""
        self._segments.append(segment)
        self._end = segment_end(segment)
        self.next_number = (segment.number + 1) % NUMBERS

    def forget(self) -> None:
        """The board has left the line, or may have."""
        self._segments.clear()
        self._end = None

    def untouched(self, sample: messages.Telemetry) -> bool:
        """The sample was taken before the board got the first segment of the line."""
        return sample.next_segment == self._first

    def expected(self, sample: messages.Telemetry) -> WirePoint | None:
        """Where the board must have been at a sample; None if that is not known.

        Segments that the board has finished are dropped.
        """
        if self._end is None:
            return None
        while self._segments and self._is_before(self._segments[0].number, sample.segment):
            self._segments.popleft()
        if self._segments:
            running = self._segments[0]
            if running.number != sample.segment or sample.segment_tick > running.ticks:
                return None
            return point_after(running, sample.segment_tick)
        if sample.segment != self.next_number:
            return None
        return WirePoint(self._end.position, STILL)

    def contradicts(self, sample: messages.Telemetry) -> bool:
        """Whether the board is not exactly where its segments lead."""
        point = self.expected(sample)
        if point is None:
            return False
        return tuple(map(whole, point.position)) != sample.commanded

    def in_board(self, sample: messages.Telemetry) -> int:
        """Segments that are in the board or on their way to it."""
        return (self.next_number - sample.segment) % NUMBERS

    @staticmethod
    def _is_before(number: int, other: int) -> bool:
        return 0 < (other - number) % NUMBERS < NUMBERS // 2
