"""Which pictures are kept: few, and spread over the job."""

from __future__ import annotations


class PictureChoice:
    """Takes a picture when it is not too near to the last one, until there are enough.

    Args:
        most: Pictures of one job.
        interval_s: Shortest time between two.

    Attributes:
        left_out: Pictures that were not taken.
    """

    def __init__(self, most: int, interval_s: float) -> None:
        self.left_out = 0
        self._room = most
        self._interval_s = interval_s
        self._last_s = float("-inf")

    def takes(self, exposed_s: float) -> bool:
        """Whether to keep the picture that was exposed then."""
        if self._room <= 0 or exposed_s - self._last_s < self._interval_s:
            self.left_out += 1
            return False
        self._room -= 1
        self._last_s = exposed_s
        return True
