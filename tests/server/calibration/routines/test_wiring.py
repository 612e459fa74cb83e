"""Motors that are connected wrongly are found before anything is fitted."""

from __future__ import annotations

import numpy as np
import pytest

from server.calibration.routines.errors import AxesSwappedError, MotorReversedError, RoutineError
from server.calibration.routines.wiring import check_wiring
from tests.server.calibration.robot.built import DRAWN, Workshop
from twin.as_built import PlanarAsBuilt

HERE = np.array([150.0, 190.0])
STEPS = 12.0 * np.eye(2)
RIGHT = np.eye(2)
SWAPPED = np.array([[0.0, 1.0], [1.0, 0.0]])


def check(wiring: np.ndarray, seed: int = 1) -> None:
    """Each motor does what the wiring makes of it, on a badly built robot."""
    built = Workshop.robot(seed).built
    moved = built.forward_many(HERE + STEPS @ wiring) - built.forward_many(HERE)
    noise = np.random.default_rng(seed).normal(0.0, 0.05, (2, 2))
    check_wiring(PlanarAsBuilt.as_drawn(DRAWN), HERE, STEPS, moved + noise)


@pytest.mark.parametrize("seed", range(10))
def test_right_wiring_of_a_bad_robot_is_right(seed: int) -> None:
    check(RIGHT, seed)


@pytest.mark.parametrize(
    ("wiring", "carriages"),
    [
        (np.diag([-1.0, 1.0]), ["left"]),
        (np.diag([1.0, -1.0]), ["right"]),
        (np.diag([-1.0, -1.0]), ["left", "right"]),
    ],
)
@pytest.mark.parametrize("seed", range(5))
def test_a_reversed_motor_is_named(wiring: np.ndarray, carriages: list[str], seed: int) -> None:
    with pytest.raises(MotorReversedError) as raised:
        check(wiring, seed)
    assert raised.value.context["carriages"] == carriages


@pytest.mark.parametrize("seed", range(5))
def test_swapped_axes_are_named(seed: int) -> None:
    with pytest.raises(AxesSwappedError):
        check(SWAPPED, seed)


def test_a_robot_that_stays_where_it_is_is_noticed() -> None:
    with pytest.raises(RoutineError, match="moved by"):
        check(0.1 * RIGHT)
