"""What whoever parked the car is told when the robot cannot reach its socket."""

from __future__ import annotations

import pytest

from server.config.insertion import InsertionSettings
from server.jobs.approach import where_it_stands
from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import gamma

GEOMETRY = RobotGeometry()
MIDDLE_RHO3_MM = 90.0


def _entry(right_mm: float, up_mm: float, further_mm: float) -> TipPosition:
    """A socket's face relative to where it is best, along the rail, up, and along the slide."""
    box = GEOMETRY.regular_box
    dy_mm, z_mm = gamma.tip_offset(GEOMETRY, MIDDLE_RHO3_MM + further_mm)
    return TipPosition(box.center_x_mm + right_mm, box.center_y_mm + up_mm + dy_mm, z_mm)


@pytest.mark.parametrize(
    ("right_mm", "up_mm", "further_mm", "sentence"),
    [
        (0, 0, 50, "The socket is 30 mm too far from the robot."),
        (0, 0, -50, "The socket is 30 mm too near to the robot."),
        (145, 0, 0, "The socket is 45 mm too far to the right."),
        (-145, 0, 0, "The socket is 45 mm too far to the left."),
        (0, 160, 0, "The socket is 60 mm too high."),
        (
            112,
            -130,
            0,
            "The socket is 12 mm too far to the right and 30 mm too low.",
        ),
        (0, 0, 20.2, "The socket is just outside what the robot can reach."),
    ],
)
def test_the_driver_learns_which_way_the_car_has_to_go(
    right_mm: float, up_mm: float, further_mm: float, sentence: str
) -> None:
    entry = _entry(right_mm, up_mm, further_mm)

    assert where_it_stands(GEOMETRY, entry, InsertionSettings()) == sentence
