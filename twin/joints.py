"""The coordinates the whole project speaks in: joints of the robot and positions of its plug tip.

All lengths are millimetres, all rates per second. Joint order is always rho1, rho2, rho3.
"""

from __future__ import annotations

from typing import NamedTuple


class JointPosition(NamedTuple):
    """Actuator positions [mm]: rho1 and rho2 along the rail, rho3 along the insertion axis."""

    rho1_mm: float
    rho2_mm: float
    rho3_mm: float


class JointVelocity(NamedTuple):
    """Actuator velocities [mm/s]."""

    rho1_mm_s: float
    rho2_mm_s: float
    rho3_mm_s: float


class JointAcceleration(NamedTuple):
    """Actuator accelerations [mm/s^2]."""

    rho1_mm_s2: float
    rho2_mm_s2: float
    rho3_mm_s2: float


class TipPosition(NamedTuple):
    """Position of the plug tip P in the base frame O-xyz [mm].

    x runs along the rail, y in the wall plane away from the rail (up), z out of the wall
    towards the car.
    """

    x_mm: float
    y_mm: float
    z_mm: float
