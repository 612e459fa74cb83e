"""The simulated robot hangs as the published tables say, and no more than they vary stays."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.simulator.sag import RobotSag
from twin.geometry import RobotGeometry
from twin.kinematics import PlatformPosition, alpha
from twin.statics import SagTables

ROBOT = RobotGeometry()
PAPER_ALPHA_MM = (0.995, 0.993, 0.991, 0.990, 0.996, 0.989, 1.030, 1.010, 1.030)
PAPER_BETA_MM = {50.0: 1.080, 75.0: 0.996, 100.0: 0.936, 125.0: 0.907, 150.0: 0.958}


def hanging_mm(scale: float = 1.0) -> NDArray[np.float64]:
    """How far the platform hangs at the nine points, row by row."""
    model = RobotSag(ROBOT, scale, SagTables())
    places = [PlatformPosition(x, y) for y in (235.0, 335.0, 435.0) for x in (550.0, 650.0, 750.0)]
    return np.array([model.of_platform_mm(*alpha.inverse(ROBOT, place)) for place in places])


def test_the_platform_hangs_at_the_nine_points_as_published() -> None:
    np.testing.assert_allclose(hanging_mm(), PAPER_ALPHA_MM, atol=1e-9)
    np.testing.assert_allclose(hanging_mm(0.5), 0.5 * np.array(PAPER_ALPHA_MM), atol=1e-9)


def test_what_a_shift_of_all_places_leaves_of_it_is_below_what_the_camera_sees() -> None:
    """Every job measures the label with the robot hanging: only what varies is left."""
    left_mm = hanging_mm() - hanging_mm().mean()
    assert np.abs(left_mm).max() == pytest.approx(0.0275, abs=0.001)
    assert np.sqrt(np.mean(left_mm**2)) < 0.02


def test_the_tip_moves_along_the_slide_by_what_the_table_differs_from_its_mean() -> None:
    model = RobotSag(ROBOT, 1.0, SagTables())
    mean_mm = np.mean(list(PAPER_BETA_MM.values()))
    for rho3_mm, beta_mm in PAPER_BETA_MM.items():
        assert model.of_tip_mm(rho3_mm) == pytest.approx(beta_mm - mean_mm, abs=1e-9)
    assert model.of_tip_mm(62.5) == pytest.approx(0.5 * (1.080 + 0.996) - mean_mm, abs=1e-9)
