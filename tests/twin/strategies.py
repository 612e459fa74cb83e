"""Random robots and poses for property tests."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from twin.geometry import JointRange, RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import inverse_unlimited, platform
from twin.kinematics.alpha import LegVectors, leg_vectors
from twin.kinematics.gamma import tip_offset

WIDE = JointRange(min_mm=-5000, max_mm=5000)
"""So wide that no joint limit interferes."""


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False)


class PosedRobot(NamedTuple):
    """A robot and a pose it can take, away from its singularities."""

    geometry: RobotGeometry
    joints: JointPosition
    tip: TipPosition

    @property
    def legs(self) -> LegVectors:
        v = platform(self.geometry, self.joints)
        return leg_vectors(self.geometry, v, self.joints.rho1_mm, self.joints.rho2_mm)


@st.composite
def geometries(draw: st.DrawFn) -> RobotGeometry:
    """Any robot: carriages at different heights, offsets of either sign, slide up or down."""
    offset = between(-80, 80)
    return RobotGeometry(
        leg_length_mm=draw(between(300, 900)),
        base_width_mm=draw(between(700, 2000)),
        platform_width_mm=draw(between(50, 300)),
        e1x_mm=draw(offset),
        e1y_mm=draw(offset),
        e2x_mm=draw(offset),
        e2y_mm=draw(offset),
        e_py_mm=draw(offset),
        e3y_mm=draw(offset),
        e3z_mm=draw(between(0, 300)),
        e4y_mm=draw(offset),
        e4z_mm=draw(offset),
        theta_rad=draw(between(-1.0, 1.0)),
        rho1=WIDE,
        rho2=WIDE,
        rho3=WIDE,
    )


@st.composite
def posed_robots(draw: st.DrawFn) -> PosedRobot:
    """Any robot in a pose whose legs rise by 20 to 95 % of their length."""
    geometry = draw(geometries())
    length = geometry.leg_length_mm
    lowest = max(geometry.e1y_mm, geometry.e2y_mm) + 0.2 * length
    highest = min(geometry.e1y_mm, geometry.e2y_mm) + 0.95 * length
    dy_mm, z_mm = tip_offset(geometry, draw(between(0, 200)))
    tip = TipPosition(draw(between(-500, 2500)), draw(between(lowest, highest)) + dy_mm, z_mm)
    return PosedRobot(geometry, inverse_unlimited(geometry, tip), tip)


def default_tips() -> st.SearchStrategy[TipPosition]:
    """Plug tips that the default robot reaches with room to spare."""
    return st.builds(TipPosition, between(560, 740), between(230, 390), between(215, 275))


def default_joints() -> st.SearchStrategy[JointPosition]:
    """Joint positions within the default travel, not all of them poses."""
    return st.builds(JointPosition, between(0, 420), between(0, 420), between(50, 150))


def straightness_mm(tips: NDArray[np.float64], start: TipPosition, target: TipPosition) -> float:
    """Largest distance of tips (N, 3) from the line through start and target."""
    axis = np.subtract(target, start)
    axis = axis / np.linalg.norm(axis)
    away = tips - np.array(start)
    return float(np.linalg.norm(away - np.outer(away @ axis, axis), axis=1).max())
