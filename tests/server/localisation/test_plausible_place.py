"""Where the label of a parked car can be."""

from __future__ import annotations

import math

import numpy as np
import pytest

from server.localisation.errors import ImplausiblePlaceError
from server.localisation.plausible_place import require_plausible_place
from tests.support.robot_cell import GEOMETRY
from twin.kinematics import gamma

BOX = GEOMETRY.regular_box


def label_at(right_mm: float, up_mm: float, before_mm: float, tilt_deg: float = 0.0) -> np.ndarray:
    """A label beside the middle, so far beyond the tip's middle reach, tilted about x."""
    angle = GEOMETRY.theta_rad + math.radians(tilt_deg)
    pose = np.eye(4)
    pose[:3, 2] = 0.0, math.sin(angle), math.cos(angle)
    middle_mm = (GEOMETRY.rho3.min_mm + GEOMETRY.rho3.max_mm) / 2
    z_mm = gamma.tip_offset(GEOMETRY, middle_mm)[1] + before_mm
    pose[:3, 3] = BOX.center_x_mm + right_mm, BOX.center_y_mm + up_mm, z_mm
    return pose


@pytest.mark.parametrize(
    "place", [(0, 0, 0), (220, 0, 0), (-220, 250, 60), (0, 0, 300), (0, 0, 0, 20)]
)
def test_a_badly_parked_car_is_still_plausible(place: tuple[float, ...]) -> None:
    require_plausible_place(GEOMETRY, label_at(*place))


@pytest.mark.parametrize(
    "place",
    [(700, 0, 0), (0, -700, 0), (0, 0, 600), (0, 0, -300), (0, 0, 0, 60), (0, 0, 0, 180)],
)
def test_a_label_where_no_car_is_is_told(place: tuple[float, ...]) -> None:
    with pytest.raises(ImplausiblePlaceError) as caught:
        require_plausible_place(GEOMETRY, label_at(*place))
    assert caught.value.code == "place_implausible"


def test_a_place_that_is_no_number_is_told() -> None:
    nowhere = label_at(0, 0, 0)
    nowhere[2, 3] = math.nan
    with pytest.raises(ImplausiblePlaceError):
        require_plausible_place(GEOMETRY, nowhere)
