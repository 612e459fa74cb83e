"""When the pictures of a stream were taken, by the stream's own time stamps."""

from __future__ import annotations

from collections import deque

REMEMBERED = 300
"""Pictures among which the promptest is sought: a few seconds, in which no two clocks part."""

CLOCK_SET_S = 5.0
"""No picture waits so long on its way; the camera's clock has been set instead."""


class StreamClock:
    """Tells how long pictures were held up on their way.

    Time stamps of a stream count from anywhere. But what they and the arrival differ by is least
    for the promptest picture, and how much more it is for another one, that one was held up: in a
    queue of the network, or of a reader that was busy.

    Args:
        latency_s: Age of the promptest pictures when they arrive.
    """

    def __init__(self, latency_s: float) -> None:
        self._latency_s = latency_s
        self._differences_s: deque[float] = deque(maxlen=REMEMBERED)

    def captured_s(self, arrived_s: float, stamped_s: float) -> float:
        """When a picture was taken, on the clock of its arrival.

        Args:
            arrived_s: When it came.
            stamped_s: Its time stamp, which counts from anywhere.
        """
        difference_s = arrived_s - stamped_s
        if self._differences_s and abs(difference_s - self._differences_s[-1]) > CLOCK_SET_S:
            self._differences_s.clear()
        self._differences_s.append(difference_s)
        held_up_s = difference_s - min(self._differences_s)
        return arrived_s - self._latency_s - held_up_s

    def restart(self) -> None:
        """The stream has begun anew: nothing is known of its time stamps."""
        self._differences_s.clear()
