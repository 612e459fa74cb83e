"""A standing car's socket stays where it is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from twin.divergence import Sighting
from twin.divergence.numbers import SocketNumbers
from twin.divergence.socket_place import SocketPlace
from twin.geometry import RobotGeometry
from twin.joints import JointPosition

NUMBERS = SocketNumbers()
HERE = JointPosition(150.0, 250.0, 60.0)
THERE = JointPosition(200.0, 200.0, 60.0)
PLACE = np.array([600.0, 340.0, 235.0])


def sighting(*shift_mm: float, sigma_mm: float = 0.01, joints: JointPosition = HERE) -> Sighting:
    place = PLACE + np.array([*shift_mm, 0.0, 0.0, 0.0][:3])
    return Sighting(0.0, place, np.eye(3) * sigma_mm**2, joints)


def test_the_first_sighting_is_the_reference() -> None:
    place = SocketPlace(RobotGeometry(), NUMBERS)
    assert place.compare(sighting(5.0)) is None
    moved = place.compare(sighting(5.6))
    assert moved is not None
    assert moved.measured == pytest.approx(0.6)


def test_the_uncertainties_of_both_pictures_and_of_the_model_add_up() -> None:
    place = SocketPlace(RobotGeometry(), NUMBERS)
    place.compare(sighting(sigma_mm=0.3))
    residual = place.compare(sighting(0.3, 0.4, sigma_mm=0.4))
    assert residual is not None
    assert residual.measured == pytest.approx(0.5)
    assert residual.sigma == pytest.approx(math.hypot(0.3, 0.4, NUMBERS.model_sigma_mm))


def test_depth_does_not_count_for_the_carriages_do_not_act_there() -> None:
    place = SocketPlace(RobotGeometry(), NUMBERS)
    place.compare(sighting())
    residual = place.compare(sighting(0.0, 0.0, 3.0))
    assert residual is not None
    assert residual.sigmas == 0


def test_the_model_is_less_sure_after_a_long_way() -> None:
    place = SocketPlace(RobotGeometry(), NUMBERS)
    place.compare(sighting())
    near, far = place.compare(sighting()), place.compare(sighting(joints=THERE))
    assert near is not None
    assert far is not None
    assert far.sigma > near.sigma + 0.9 * NUMBERS.model_sigma_fraction * 50


def test_another_job_begins_anew() -> None:
    place = SocketPlace(RobotGeometry(), NUMBERS)
    place.compare(sighting())
    place.forget()
    assert place.compare(sighting(80.0)) is None
