"""The least value of a smooth function of one number, by sampling and zooming in."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from twin.workspace.boundary import Array

SAMPLES = 512
ZOOM_SAMPLES = 65
RELATIVE_WIDTH = 1e-13


def least_on(function: Callable[[Array], Array], low: float, high: float) -> tuple[float, float]:
    """Where a function is least on a closed interval, and its value there.

    The sampling finds the right valley of any function that has no valley narrower than
    (high - low) / SAMPLES; zooming in then finds its bottom to rounding.

    Args:
        function: From an array of numbers to an array of values of the same shape.
        low: Lower end.
        high: Upper end.

    Returns:
        (argument, value).
    """
    start, end, count = low, high, SAMPLES + 1
    while True:
        arguments = np.linspace(start, end, count)
        values = function(arguments)
        best = int(np.argmin(values))
        if end - start <= RELATIVE_WIDTH * max(high - low, abs(low), abs(high)):
            return float(arguments[best]), float(values[best])
        start = float(arguments[max(best - 1, 0)])
        end = float(arguments[min(best + 1, count - 1)])
        count = ZOOM_SAMPLES
