"""The hanging charging cable as a catenary of fixed length."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

LENGTH_MM = 1500.0
SEGMENTS = 40

_LEAST_SPAN_MM = 1.0


def _half_span(ratio: float) -> float:
    """Solves sinh(u) / u = ratio for u > 0 by Newton's method on its logarithm."""
    u = math.sqrt(6 * (ratio - 1)) if ratio < 3 else math.log(2 * ratio * math.log(2 * ratio))
    for _ in range(30):
        sinh_u = -math.expm1(-2 * u) / 2  # times exp(u), which overflows for a very slack cable
        error = u + math.log(sinh_u / u) - math.log(ratio)
        step = error / (1 / math.tanh(u) - 1 / u)
        u -= step
        if abs(step) < 1e-13 * u:
            break
    return u


def hanging(
    start_mm: Points, end_mm: Points, *, length_mm: float = LENGTH_MM, segments: int = SEGMENTS
) -> Points:
    """Points at equal distances along a cable that hangs between two ends.

    In the vertical plane through both ends the cable is y = a cosh(x / a), and the arc from its
    lowest point is s = a sinh(x / a). With the horizontal span h, the rise v and u = h / (2 a):
    sinh(u) / u = sqrt(length^2 - v^2) / h, and the middle of the span lies at a atanh(v / length).

    Args:
        start_mm: First end, y up, shape (3,).
        end_mm: Last end, shape (3,). A cable that is too short for its ends is drawn straight.
        length_mm: Length of the cable.
        segments: Number of equal parts.

    Returns:
        Shape (segments + 1, 3); the first and the last point are the ends.
    """
    across = end_mm - start_mm
    rise = float(across[1])
    span = math.hypot(float(across[0]), float(across[2]))
    fractions = np.linspace(0.0, 1.0, segments + 1)
    straight = np.asarray(start_mm + fractions[:, None] * across)
    slack = length_mm**2 - rise**2 - span**2
    if slack <= 1e-9 * length_mm**2:
        return straight
    h = max(span, _LEAST_SPAN_MM)
    a = h / (2 * _half_span(math.sqrt(length_mm**2 - rise**2) / h))
    left = a * math.atanh(rise / length_mm) - h / 2
    arc = a * math.sinh(left / a) + fractions * length_mm
    x = a * np.arcsinh(arc / a)
    y = np.hypot(a, arc)
    points = straight.copy()
    part = (x - x[0]) / h
    points[:, 0] = start_mm[0] + part * across[0]
    points[:, 2] = start_mm[2] + part * across[2]
    points[:, 1] = start_mm[1] + (y - y[0])
    points[-1] = end_mm
    return points


def along(points_mm: Points) -> tuple[Points, Points]:
    """Middles [mm], shape (N, 3), and orientations (w, x, y, z), shape (N, 4), of the parts.

    Each part's z axis points along the cable: the shortest turn from z to the direction t is
    the quaternion (1 + t_z, -t_y, t_x, 0), normalised.
    """
    directions = np.diff(points_mm, axis=0)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    quaternions = np.column_stack(
        [1 + directions[:, 2], -directions[:, 1], directions[:, 0], np.zeros(len(directions))]
    )
    backwards = quaternions[:, 0] < 1e-9
    quaternions[backwards] = (0.0, 1.0, 0.0, 0.0)
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    return (points_mm[:-1] + points_mm[1:]) / 2, quaternions
