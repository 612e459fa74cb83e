"""When pictures were taken, and how many were lost between two of them."""

from __future__ import annotations


class FrameGaps:
    """Tells lost frames by the time between two that came.

    Args:
        frames_per_s: Nominal rate of the camera.
    """

    def __init__(self, frames_per_s: float) -> None:
        self._period_s = 1.0 / frames_per_s
        self._last_s: float | None = None

    def frames_since_last(self, captured_s: float) -> int:
        """Periods since the frame before, rounded; 1 for the first, and never less."""
        last_s, self._last_s = self._last_s, captured_s
        if last_s is None:
            return 1
        return max(1, round((captured_s - last_s) / self._period_s))

    def restart(self) -> None:
        """Nothing is known of frames before."""
        self._last_s = None
