"""What the board wants of the joints over time: a line of constant-acceleration pieces.

Behind the last pushed segment there is always a way to come to rest: if it ends with velocity
and no other follows in time, the board decelerates by itself. So the line is defined for ever,
and whoever asks late still gets what happened in the meantime.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.segments import Segment

STILL = JointVelocity(0.0, 0.0, 0.0)
UNACCELERATED = JointAcceleration(0.0, 0.0, 0.0)


class SetPoint(NamedTuple):
    """Position, velocity and acceleration that the joints should have."""

    position: JointPosition
    velocity: JointVelocity
    acceleration: JointAcceleration


class Piece(NamedTuple):
    """One segment at its place in time; it is left at ``end_s``, early if it was cut off."""

    start_s: float
    end_s: float
    segment: Segment

    def at(self, t_s: float) -> SetPoint:
        """The set point at a time within the piece."""
        elapsed_s = t_s - self.start_s
        return SetPoint(
            self.segment.position_at(elapsed_s),
            self.segment.velocity_at(elapsed_s),
            self.segment.acceleration,
        )

    @property
    def end(self) -> JointPosition:
        """Where the piece is left."""
        return self.segment.position_at(self.end_s - self.start_s)


def resting_at(position: JointPosition, at_s: float) -> Piece:
    """A piece of no duration, after which the joints keep the position."""
    return Piece(at_s, at_s, Segment(0.0, position, STILL, UNACCELERATED))


class SetPointLine:
    """The past, present and future of the set point.

    Args:
        position: Where the joints rest at first.
        at_s: From when on.
        deceleration_mm_s2: How fast the board brings each joint to rest by itself.
        still_mm_s: An end velocity up to this counts as rest.
    """

    def __init__(
        self,
        position: JointPosition,
        at_s: float,
        *,
        deceleration_mm_s2: tuple[float, float, float],
        still_mm_s: float,
    ) -> None:
        self._deceleration = deceleration_mm_s2
        self._still_mm_s = still_mm_s
        self._pieces = [resting_at(position, at_s)]
        self._tail: Piece | None = None
        self._taken = 0

    def at(self, t_s: float) -> SetPoint:
        """The set point at a time, past or future."""
        if self._tail is not None and t_s >= self._tail.start_s:
            piece = self._tail
        else:
            index = bisect_right(self._pieces, t_s, key=lambda piece: piece.start_s) - 1
            piece = self._pieces[max(index, 0)]
        if t_s <= piece.end_s:
            return piece.at(max(t_s, piece.start_s))
        return SetPoint(piece.end, STILL, UNACCELERATED)

    def pieces_between(self, from_s: float, to_s: float) -> Iterator[tuple[float, Piece | None]]:
        """Cut a stretch of time at the joints between pieces.

        Yields:
            (until_s, piece): the piece that holds up to then; None where the joints rest.
        """
        line = self._pieces if self._tail is None else [*self._pieces, self._tail]
        first = max(bisect_right(line, from_s, key=lambda piece: piece.start_s) - 1, 0)
        now_s = from_s
        for piece in line[first:]:
            if piece.start_s >= to_s:
                break
            if piece.start_s > now_s:
                now_s = piece.start_s
                yield now_s, None
            if piece.end_s > now_s:
                now_s = min(piece.end_s, to_s)
                yield now_s, piece
        if now_s < to_s:
            yield to_s, None

    @property
    def rests_from_s(self) -> float:
        """When the set point stops moving for good."""
        return self._tail.end_s if self._tail is not None else self._pieces[-1].end_s

    def queue_end(self, now_s: float) -> tuple[float, JointPosition, JointVelocity]:
        """When, where and how fast the next pushed segment must begin."""
        last = self._pieces[-1]
        if self._tail is not None and now_s >= self._tail.end_s:
            return now_s, self._tail.end, STILL
        if self._tail is None and now_s >= last.end_s:
            return now_s, last.end, STILL
        return last.end_s, last.end, last.segment.velocity_at(last.end_s - last.start_s)

    def waiting(self, now_s: float) -> int:
        """Number of segments that are in the queue or being executed."""
        count = 0
        for piece in reversed(self._pieces):
            if piece.end_s <= now_s:
                break
            count += 1
        return count

    def done(self, now_s: float) -> int:
        """Number of segments that are over, or were dropped, of all that were ever appended."""
        return self._taken - self.waiting(now_s)

    def ran_empty(self, now_s: float) -> bool:
        """Whether the last segment has ended with velocity and nothing followed."""
        return self._tail is not None and now_s >= self._tail.start_s

    def append(self, now_s: float, segments: Sequence[Segment]) -> None:
        """Put segments behind those that wait; the first begins at once if none does."""
        start_s, _, _ = self.queue_end(now_s)
        if self._tail is not None and now_s >= self._tail.end_s:
            self._pieces.append(self._tail)
        self._taken += len(segments)
        for segment in segments:
            end_s = start_s + segment.duration_s
            self._pieces.append(Piece(start_s, end_s, segment))
            start_s = end_s
        last = segments[-1]
        self._tail = self._braking(start_s, last.end, last.end_velocity)

    def brake(self, now_s: float, *, rho3_mm: float | None = None) -> None:
        """Drop everything from now on and come to rest.

        Args:
            now_s: When.
            rho3_mm: Where the slide stops at once instead; None lets it decelerate too.
        """
        position, velocity, _ = self.at(now_s)
        if rho3_mm is not None:
            position = position._replace(rho3_mm=rho3_mm)
            velocity = velocity._replace(rho3_mm_s=0.0)
        self.jump(now_s, position)
        self._tail = self._braking(now_s, position, velocity)

    def jump(self, now_s: float, position: JointPosition) -> None:
        """Drop everything from now on and rest at a position from this instant."""
        self._tail = self._cut(self._tail, now_s) if self._tail is not None else None
        kept = [self._cut(piece, now_s) for piece in self._pieces if piece.start_s < now_s]
        if self._tail is not None and self._tail.start_s < now_s:
            kept.append(self._tail)
        self._tail = None
        self._pieces = [*kept, resting_at(position, now_s)]

    def forget(self, before_s: float) -> None:
        """Drop what ended before a time, except for the piece that says where the joints are."""
        keep = max(bisect_right(self._pieces, before_s, key=lambda piece: piece.end_s) - 1, 0)
        del self._pieces[:keep]

    @staticmethod
    def _cut(piece: Piece, now_s: float) -> Piece:
        return piece._replace(end_s=min(piece.end_s, now_s))

    def _braking(
        self, start_s: float, position: JointPosition, velocity: JointVelocity
    ) -> Piece | None:
        """The one piece in which all joints come to rest together, or None at rest."""
        if max(abs(v) for v in velocity) <= self._still_mm_s:
            return None
        duration_s = max(abs(v) / a for v, a in zip(velocity, self._deceleration, strict=True))
        braking = JointAcceleration(*(-v / duration_s for v in velocity))
        segment = Segment(duration_s, position, velocity, braking)
        return Piece(start_s, start_s + duration_s, segment)
