"""From where the car is to what its driver is told: a small state machine that does not flicker.

``Adviser.advise`` is asked after every picture. What it would say is worked out anew each time;
what it says changes only when the new state has lasted for a while, the braking word excepted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from server.config.guidance import GuidanceSettings
from server.guidance import words
from server.guidance.model import (
    CarEstimate,
    Direction,
    GuidanceState,
    PauseReason,
    Step,
    Unseen,
)
from server.guidance.reach import Reach, Standing
from server.guidance.rounding import SteadyNumber
from server.guidance.words import Words

NEAR_MM = 500.0
"""Nearer than this to the place, slowness is asked for."""

LEAST_STEP_MM = 4.0
"""Nobody drives less on purpose."""

LEAST_SPEED_MM_S = 15.0
"""Slower is standing, as far as braking goes."""

LEAST_BRAKING_MM_S2 = 150.0
"""Less is rolling out."""

_AT_ONCE = {GuidanceState.STOP, GuidanceState.PAUSED}
_BLIND = {GuidanceState.SEARCHING, GuidanceState.UNREADABLE, GuidanceState.LOST}
"""Whatever comes after these is news."""


@dataclass(frozen=True, slots=True)
class Advice:
    """What the driver is told.

    Attributes:
        state: In one word.
        since_s: Since when, event loop time.
        words: In sentences.
        steps: What to do, the most important first; empty when there is nothing.
        margin_mm: Of the socket inside the good zone; negative outside, None without a car.
    """

    state: GuidanceState
    since_s: float
    words: Words
    steps: tuple[Step, ...] = ()
    margin_mm: float | None = None


@dataclass(frozen=True, slots=True)
class _Draft:
    state: GuidanceState
    words: Words
    steps: tuple[Step, ...] = ()
    margin_mm: float | None = None


class Adviser:
    """Decides what to say.

    Args:
        reach: Where a socket may be.
        settings: When words change.
        max_skew_rad: What the plug's holder can follow.
        now_s: Event loop time now.
    """

    def __init__(
        self, reach: Reach, settings: GuidanceSettings, max_skew_rad: float, now_s: float
    ) -> None:
        self._reach = reach
        self._settings = settings
        self._max_skew_rad = max_skew_rad
        self._numbers = {axis: SteadyNumber() for axis in "xyz"}
        self._advice = Advice(GuidanceState.SEARCHING, now_s, words.UNSEEN[Unseen.NOTHING])
        self._rival: GuidanceState | None = None
        self._rival_since_s = now_s

    @property
    def advice(self) -> Advice:
        """What the driver is told now."""
        return self._advice

    def pause(self, reason: PauseReason, now_s: float) -> Advice:
        """There is no guidance."""
        return self._say(_Draft(GuidanceState.PAUSED, words.PAUSED[reason]), now_s)

    def miss(self, why: Unseen, now_s: float) -> Advice:
        """There is no car, or none that could be made out."""
        state = GuidanceState.SEARCHING if why is Unseen.NOTHING else GuidanceState.UNREADABLE
        return self._say(_Draft(state, words.UNSEEN[why]), now_s)

    def lose(self, edge: Direction | None, now_s: float) -> Advice:
        """The car was there a moment ago; the edge says where its label left the picture."""
        return self._say(_Draft(GuidanceState.LOST, words.lost(edge)), now_s)

    def advise(self, car: CarEstimate, now_s: float) -> Advice:
        """There is a car, and this is where."""
        standing = self._reach.standing(self._reach.good, car.place_mm, car.covariance_mm2)
        draft = self._of_standing(car, standing) if car.still else self._of_moving(car, standing)
        return self._say(draft, now_s)

    # --- the decision ------------------------------------------------------------------------

    def _of_standing(self, car: CarEstimate, standing: Standing) -> _Draft:
        if self._surely_skewed(car):
            return _Draft(GuidanceState.SKEWED, self._skew_words(car), margin_mm=standing.margin_mm)
        if standing.margin_mm >= self._allowed_mm(GuidanceState.GOOD):
            said = words.GOOD_FLAWED if car.flawed else words.GOOD
            return _Draft(GuidanceState.GOOD, said, margin_mm=standing.margin_mm)
        steps = self._steps(car, standing)
        least = self._reach.standing(self._reach.reachable, car.place_mm, car.covariance_mm2)
        if least.margin_mm >= self._allowed_mm(GuidanceState.THIN) or not steps:
            return _Draft(GuidanceState.THIN, words.thin(steps), steps, standing.margin_mm)
        said = words.move(steps, words.Manner.STANDS)
        return _Draft(GuidanceState.MOVE, said, steps, standing.margin_mm)

    def _of_moving(self, car: CarEstimate, standing: Standing) -> _Draft:
        to_go_mm = float(car.place_mm[2]) - self._reach.stop_z_mm
        if self._must_brake(car, to_go_mm):
            return _Draft(GuidanceState.STOP, words.STOP, margin_mm=standing.margin_mm)
        steps = self._steps(car, standing)
        if not steps:  # rolling out inside the place
            return _Draft(GuidanceState.STOP, words.STOP, margin_mm=standing.margin_mm)
        near = 0.0 < to_go_mm < NEAR_MM
        manner = words.Manner.ROLLS
        if near and car.approach_mm_s > self._settings.slow_mm_s:
            manner = words.Manner.TOO_FAST
        elif self._surely_skewed(car):
            manner = words.Manner.ASKEW
        said = words.move(steps, manner)
        return _Draft(GuidanceState.MOVE, said, steps, standing.margin_mm)

    def _must_brake(self, car: CarEstimate, to_go_mm: float) -> bool:
        """Told now, the driver comes to a stop at the place or behind it."""
        speed, settings = car.approach_mm_s, self._settings
        if speed < LEAST_SPEED_MM_S:
            return False
        if to_go_mm < self._reach.good.depth.low_mm - self._reach.stop_z_mm:
            return True  # too far in already, and still coming
        rolls_mm = speed * settings.reaction_s + speed**2 / (2 * settings.braking_mm_s2)
        if car.braking_mm_s2 > LEAST_BRAKING_MM_S2:  # the foot is on the brake already
            rolls_mm = min(rolls_mm, speed**2 / (2 * car.braking_mm_s2))
        return rolls_mm >= to_go_mm

    def _surely_skewed(self, car: CarEstimate) -> bool:
        """Beyond the limit by so much more than it is uncertain; said, it needs as much to end."""
        doubt = self._settings.skew_certainty * car.skew_sigma_rad
        if self._advice.state is GuidanceState.SKEWED:
            return car.skew_rad + 0.5 * doubt > self._max_skew_rad
        return car.skew_rad - doubt > self._max_skew_rad

    def _skew_words(self, car: CarEstimate) -> Words:
        turn = None
        if abs(car.turned_rad) > 0.7 * car.skew_rad:
            turn = Direction.RIGHT if car.turned_rad > 0 else Direction.LEFT
        return words.skewed(math.degrees(car.skew_rad), math.degrees(self._max_skew_rad), turn)

    def _allowed_mm(self, state: GuidanceState) -> float:
        """What a state may lack once it has been said."""
        return -self._settings.hysteresis_mm if self._advice.state is state else 0.0

    def _steps(self, car: CarEstimate, standing: Standing) -> tuple[Step, ...]:
        """The way into the good zone: to its middle in depth, just inside it sideways."""
        inset_mm = self._settings.hysteresis_mm
        to_z = self._reach.stop_z_mm - float(car.place_mm[2]) if standing.to_z_mm else 0.0
        if not car.still and not to_z and car.approach_mm_s > LEAST_SPEED_MM_S:
            to_z = min(0.0, self._reach.stop_z_mm - float(car.place_mm[2]))
        ways = {
            "y": _further(standing.to_y_mm, inset_mm),
            "x": _further(standing.to_x_mm, inset_mm),
            "z": to_z,
        }
        steps = []
        for axis, way_mm in ways.items():
            if abs(way_mm) < LEAST_STEP_MM:
                self._numbers[axis].forget()
                continue
            shown = self._numbers[axis].show(way_mm)
            direction = _direction(axis, way_mm, faces_robot=car.faces_robot)
            steps.append(Step(direction, abs(way_mm), shown))
        # From afar the way in comes first: there is room to steer on it.
        far = abs(to_z) > 2 * abs(ways["x"])
        order = {Direction.UP: 0, Direction.DOWN: 0}
        along = {Direction.FORWARD, Direction.BACK}
        steps.sort(
            key=lambda step: order.get(step.direction, 1 if (step.direction in along) == far else 2)
        )
        return tuple(steps)

    # --- steadiness --------------------------------------------------------------------------

    def _say(self, draft: _Draft, now_s: float) -> Advice:
        if draft.state is self._advice.state:
            self._rival = None
            return self._take(draft, self._advice.since_s)
        if draft.state is not self._rival:
            self._rival, self._rival_since_s = draft.state, now_s
        news = self._advice.state in _BLIND and draft.state not in _BLIND
        hold_s = 0.0 if news or draft.state in _AT_ONCE else self._settings.hold_s
        if now_s - self._rival_since_s < hold_s:
            return self._advice
        self._rival = None
        return self._take(draft, now_s)

    def _take(self, draft: _Draft, since_s: float) -> Advice:
        self._advice = Advice(draft.state, since_s, draft.words, draft.steps, draft.margin_mm)
        return self._advice


def _further(way_mm: float, by_mm: float) -> float:
    """A way that ends not on the edge but inside."""
    return way_mm + math.copysign(by_mm, way_mm) if way_mm else 0.0


def _direction(axis: str, way_mm: float, *, faces_robot: bool) -> Direction:
    """Left and right are the driver's, who sits with the face or the back to the robot."""
    if axis == "y":
        return Direction.UP if way_mm > 0 else Direction.DOWN
    if axis == "x":
        return Direction.RIGHT if (way_mm > 0) == faces_robot else Direction.LEFT
    return Direction.FORWARD if (way_mm < 0) == faces_robot else Direction.BACK
