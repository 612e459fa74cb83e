"""When the frames of a rolling shutter are exposed, read and delivered."""

from __future__ import annotations

import math
from dataclasses import dataclass

from drivers.simulator.camera.imaging import ImagingParameters

_ROUNDING_S = 1e-9


@dataclass(frozen=True, slots=True)
class FrameClock:
    """The read-out keeps time; a longer exposure begins earlier.

    Row 0 of frame n is read at opening + n / rate + the configured exposure, the last row
    readout_s later, and latency_s after that the frame is delivered.

    Attributes:
        imaging: Rate, read-out and latency.
        opened_at_s: Event loop time of the opening.
    """

    imaging: ImagingParameters
    opened_at_s: float

    def read_at_s(self, number: int) -> float:
        """When the first row of a frame is read."""
        imaging = self.imaging
        return self.opened_at_s + number / imaging.frames_per_s + imaging.exposure_s

    def middle_s(self, number: int, exposure_s: float) -> float:
        """Middle of the exposure of the middle row."""
        return self.read_at_s(number) + (self.imaging.readout_s - exposure_s) / 2

    def delivered_at_s(self, number: int) -> float:
        """When a frame can be had."""
        return self.read_at_s(number) + self.imaging.readout_s + self.imaging.latency_s

    def next_number(self, now_s: float, exposed_after_s: float | None) -> int:
        """Number of the next frame to be delivered none of whose rows began too early."""
        imaging = self.imaging
        rate = imaging.frames_per_s
        since_s = now_s - self.delivered_at_s(0) + _ROUNDING_S
        number = max(math.floor(since_s * rate) + 1, 0)
        if exposed_after_s is None:
            return number
        longest_s = imaging.exposure_s
        if imaging.automatic_exposure:
            longest_s = imaging.longest_exposure_s
        began_s = exposed_after_s - (self.read_at_s(0) - longest_s) - _ROUNDING_S
        return max(number, math.ceil(began_s * rate))
