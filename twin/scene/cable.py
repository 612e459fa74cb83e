"""The hanging charging cable as a catenary of fixed length, and how hard it pulls."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from twin.statics.loads import GRAVITY_M_S2, Loads

Points = NDArray[np.float64]

SEGMENTS = 40

_LEAST_SPAN_MM = 1.0


@dataclass(frozen=True, slots=True)
class Cable:
    """The charging cable.

    Attributes:
        length_mm: Length between the station and the plug.
        mass_kg: Mass of this length.
    """

    length_mm: float
    mass_kg: float

    def __post_init__(self) -> None:
        if not (0 < self.length_mm < math.inf and 0 <= self.mass_kg < math.inf):
            msg = "a cable needs a length_mm greater than zero and a mass_kg that is not negative"
            raise ValueError(msg)

    @classmethod
    def of(cls, loads: Loads) -> Self:
        """The cable that hangs on the robot."""
        return cls(loads.cable_length_mm, loads.cable_mass_kg)

    @property
    def weight_n_mm(self) -> float:
        """Weight of a millimetre [N/mm]."""
        return self.mass_kg * GRAVITY_M_S2 / self.length_mm


class _Catenary(NamedTuple):
    """y = a cosh(x / a) with x from its lowest point: a, and x at the first end [mm]."""

    a: float
    left: float
    span: float


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


def _catenary(start_mm: Points, end_mm: Points, length_mm: float) -> _Catenary | None:
    """The curve between two ends, None if the cable is too short to hang.

    In the vertical plane through both ends the cable is y = a cosh(x / a), and the arc from its
    lowest point is s = a sinh(x / a). With the horizontal span h, the rise v and u = h / (2 a):
    sinh(u) / u = sqrt(length^2 - v^2) / h, and the middle of the span lies at a atanh(v / length).
    """
    across = end_mm - start_mm
    rise = float(across[1])
    span = math.hypot(float(across[0]), float(across[2]))
    if length_mm**2 - rise**2 - span**2 <= 1e-9 * length_mm**2:
        return None
    h = max(span, _LEAST_SPAN_MM)
    a = h / (2 * _half_span(math.sqrt(length_mm**2 - rise**2) / h))
    return _Catenary(a, a * math.atanh(rise / length_mm) - h / 2, h)


def hanging(
    start_mm: Points, end_mm: Points, *, length_mm: float, segments: int = SEGMENTS
) -> Points:
    """Points at equal distances along a cable that hangs between two ends.

    Args:
        start_mm: First end, y up, shape (3,).
        end_mm: Last end, shape (3,). A cable that is too short for its ends is drawn straight.
        length_mm: Length of the cable.
        segments: Number of equal parts.

    Returns:
        Shape (segments + 1, 3); the first and the last point are the ends.
    """
    across = end_mm - start_mm
    fractions = np.linspace(0.0, 1.0, segments + 1)
    points = np.asarray(start_mm + fractions[:, None] * across)
    curve = _catenary(start_mm, end_mm, length_mm)
    if curve is None:
        return points
    a, left, span = curve
    arc = a * math.sinh(left / a) + fractions * length_mm
    x = a * np.arcsinh(arc / a)
    y = np.hypot(a, arc)
    part = (x - x[0]) / span
    points[:, 0] = start_mm[0] + part * across[0]
    points[:, 2] = start_mm[2] + part * across[2]
    points[:, 1] = start_mm[1] + (y - y[0])
    points[-1] = end_mm
    return points


def pull_n(cable: Cable, start_mm: Points, end_mm: Points) -> Points | None:
    """Force of a hanging cable on what holds its last end [N], shape (3,).

    Its horizontal part is the weight of a length a everywhere; its vertical part is the weight
    of the arc down to the lowest point.

    Returns:
        None if the cable is taut: its shape does not say then how hard it pulls.
    """
    curve = _catenary(start_mm, end_mm, cable.length_mm)
    if curve is None:
        return None
    a, left, span = curve
    across = end_mm - start_mm
    arc = a * math.sinh(left / a) + cable.length_mm
    horizontal = -a / max(span, _LEAST_SPAN_MM) * across
    return np.asarray(cable.weight_n_mm * np.array([horizontal[0], -arc, horizontal[2]]))


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
