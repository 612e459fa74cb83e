"""Stops a motion whose force along the insertion axis goes over its limit."""

from __future__ import annotations

import math
from collections import deque
from statistics import median

from drivers.robot import RobotState
from server.control.errors import ForceLimitError

SAMPLES = 5
"""The median of so many samples counts: 50 ms, in which one noisy sample means nothing. The board
caps the force by itself without any delay."""


class ForceWatch:
    """Judges every sample of a motion and remembers the extremes.

    Args:
        push_limit_n: Largest force towards the car.
        pull_limit_n: Largest force away from it.
    """

    def __init__(self, *, push_limit_n: float = math.inf, pull_limit_n: float = math.inf) -> None:
        self.largest_push_n = 0.0
        self.largest_pull_n = 0.0
        self._push_limit_n = push_limit_n
        self._pull_limit_n = pull_limit_n
        self._recent: deque[float] = deque(maxlen=SAMPLES)

    def check(self, state: RobotState) -> None:
        """Take in a sample.

        Raises:
            ForceLimitError: the force is over its limit.
        """
        self._recent.append(state.force_n)
        if len(self._recent) < SAMPLES:
            return
        force_n = median(self._recent)
        self.largest_push_n = max(self.largest_push_n, force_n)
        self.largest_pull_n = max(self.largest_pull_n, -force_n)
        if force_n > self._push_limit_n:
            raise ForceLimitError(
                f"Pushing took {force_n:.0f} N; the limit is {self._push_limit_n:.0f} N.",
                force_n=round(force_n, 1),
                limit_n=self._push_limit_n,
            )
        if -force_n > self._pull_limit_n:
            raise ForceLimitError(
                f"Pulling took {-force_n:.0f} N; the limit is {self._pull_limit_n:.0f} N.",
                force_n=round(force_n, 1),
                limit_n=self._pull_limit_n,
            )
