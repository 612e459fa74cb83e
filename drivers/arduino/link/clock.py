"""The board's clock as seen from the host: which tick was when.

The board answers a question at some time between its sending and the arrival of the answer. A
straight line through the middles of quick answers gives offset and rate of its clock; slow
answers, which were held up on one of the two ways, count little. The idea is Klipper's
(klippy/clocksync.py).
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

TICK_RANGE = 1 << 32
"""The counter of the board wraps here."""

KEPT_ANSWERS = 32

RATE_UNCERTAINTY = 0.005
"""Standard deviation of a board's clock rate, relative: it may have a ceramic resonator."""

TIMING_UNCERTAINTY_S = 2e-4
"""Standard deviation of the middle of the quickest answer."""


@dataclass(frozen=True, slots=True)
class _Answer:
    middle_s: float
    round_trip_s: float
    tick: int


class BoardClock:
    """Estimates the clock of a board from questions and answers.

    Args:
        tick_hz: Its nominal rate.
    """

    def __init__(self, tick_hz: float) -> None:
        self._nominal_s = 1.0 / tick_hz
        self._answers: deque[_Answer] = deque(maxlen=KEPT_ANSWERS)
        self._last_tick = 0
        self._origin_tick = 0
        self._origin_s = 0.0
        self._tick_s = self._nominal_s

    @property
    def known(self) -> bool:
        """At least one answer has come."""
        return bool(self._answers)

    @property
    def tick_s(self) -> float:
        """Estimated length of a tick on the host's clock [s]."""
        return self._tick_s

    @property
    def round_trips_s(self) -> list[float]:
        """How long the newest answers took [s], oldest first; at most KEPT_ANSWERS."""
        return [answer.round_trip_s for answer in self._answers]

    def add_answer(self, asked_s: float, answered_s: float, tick: int) -> None:
        """Learn from an answer.

        Args:
            asked_s: When the question went out, host time.
            answered_s: When the answer came in, host time.
            tick: The board's counter in the answer.
        """
        middle_s = 0.5 * (asked_s + answered_s)
        self._answers.append(_Answer(middle_s, answered_s - asked_s, self._unwrap(tick)))
        self._fit()

    def host_time_s(self, tick: int) -> float:
        """When a recent tick was, on the host's clock.

        Raises:
            ValueError: no answer has come yet.
        """
        if not self._answers:
            raise ValueError("the board's clock is not known yet")
        return self._origin_s + (self._unwrap(tick) - self._origin_tick) * self._tick_s

    def _unwrap(self, tick: int) -> int:
        """The counter without wraps: the value nearest to the last one."""
        half = TICK_RANGE // 2
        step = (tick - self._last_tick + half) % TICK_RANGE - half
        if not self._answers and not self._last_tick:
            step = tick
        self._last_tick += step
        return self._last_tick

    def _fit(self) -> None:
        """Weighted least squares of time over tick, with the nominal rate as prior knowledge."""
        quickest_s = min(answer.round_trip_s for answer in self._answers)
        weights = [
            # An answer that took d longer may be wrong by d / 2.
            1.0 / (TIMING_UNCERTAINTY_S**2 + (0.5 * (answer.round_trip_s - quickest_s)) ** 2)
            for answer in self._answers
        ]
        total = sum(weights)
        ticks = [answer.tick - self._answers[0].tick for answer in self._answers]
        times = [answer.middle_s - self._answers[0].middle_s for answer in self._answers]
        mean_tick = sum(w * tick for w, tick in zip(weights, ticks, strict=True)) / total
        mean_time = sum(w * time for w, time in zip(weights, times, strict=True)) / total
        prior = 1.0 / (RATE_UNCERTAINTY * self._nominal_s) ** 2
        squares = products = 0.0
        for w, tick, time in zip(weights, ticks, times, strict=True):
            squares += w * (tick - mean_tick) ** 2
            products += w * (tick - mean_tick) * (time - mean_time)
        self._tick_s = (products + prior * self._nominal_s) / (squares + prior)
        self._origin_tick = self._answers[0].tick
        self._origin_s = self._answers[0].middle_s + mean_time - mean_tick * self._tick_s
