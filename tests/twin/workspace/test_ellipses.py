from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.twin.strategies import PosedRobot, posed_robots
from tests.twin.workspace.robots import DEFAULT, UNEVEN, Array
from twin.kinematics import (
    LegsCannotCloseError,
    NearSingularityError,
    PlatformPosition,
    UnreachableError,
    alpha,
    platform,
)
from twin.statics import alpha_actuator_forces
from twin.workspace import Ellipse, force_ellipse, velocity_ellipse

TURN = np.linspace(0, 2 * np.pi, 60)
CIRCLE = np.column_stack((np.cos(TURN), np.sin(TURN)))


def radius_in(ellipse: Ellipse, points: Array) -> Array:
    """1 for points of the ellipse."""
    cosine, sine = math.cos(ellipse.angle_rad), math.sin(ellipse.angle_rad)
    along = points @ np.array([cosine, sine]) / ellipse.semi_major
    across = points @ np.array([-sine, cosine]) / ellipse.semi_minor
    return np.asarray(np.hypot(along, across))


@given(posed_robots())
def test_carriage_velocities_on_the_circle_move_the_platform_on_the_ellipse(
    robot: PosedRobot,
) -> None:
    v = platform(robot.geometry, robot.joints)
    ellipse = velocity_ellipse(robot.geometry, v)
    velocities = CIRCLE @ alpha.jacobian(robot.legs).T
    np.testing.assert_allclose(radius_in(ellipse, velocities), 1, atol=1e-6)
    assert ellipse.semi_major >= ellipse.semi_minor
    assert -math.pi / 2 < ellipse.angle_rad <= math.pi / 2


@given(posed_robots())
def test_forces_of_the_ellipse_ask_carriage_forces_on_the_circle(robot: PosedRobot) -> None:
    v = platform(robot.geometry, robot.joints)
    for fx, fy in force_ellipse(robot.geometry, v).points(20):
        forces = alpha_actuator_forces(robot.legs, fx, fy)
        assert math.hypot(*forces) == pytest.approx(1, abs=1e-6)


def test_the_symmetric_robot_has_upright_axes() -> None:
    v = PlatformPosition(650, 335)
    ellipse = velocity_ellipse(DEFAULT, v)
    d = math.sqrt(532**2 - 335**2)
    # both carriages together move it along x with half their sum, against each other along y
    assert ellipse.semi_minor == pytest.approx(math.sqrt(0.5))
    assert ellipse.semi_major == pytest.approx(d / 335 * math.sqrt(0.5))
    assert abs(ellipse.angle_rad) == pytest.approx(math.pi / 2)
    assert force_ellipse(DEFAULT, v).angle_rad == pytest.approx(0, abs=1e-9)


def test_the_drawn_line_is_closed_and_keeps_to_the_axes() -> None:
    ellipse = velocity_ellipse(DEFAULT, PlatformPosition(700, 300))
    points = ellipse.points(361)
    np.testing.assert_allclose(points[0], points[-1], atol=1e-12)
    radii = np.hypot(*points.T)
    assert radii.max() == pytest.approx(ellipse.semi_major)
    assert radii.min() == pytest.approx(ellipse.semi_minor, rel=1e-3)


def test_poses_without_an_ellipse() -> None:
    with pytest.raises(UnreachableError):
        velocity_ellipse(DEFAULT, PlatformPosition(650, 600))
    with pytest.raises(LegsCannotCloseError, match="folded flat"):
        force_ellipse(DEFAULT, PlatformPosition(650, 0))
    with pytest.raises(NearSingularityError, match="stands upright at y = 472"):
        force_ellipse(UNEVEN, PlatformPosition(650, -60 + 532))
