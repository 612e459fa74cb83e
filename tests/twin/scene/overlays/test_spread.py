"""The ellipsoid of the measured socket."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from viser.transforms import SO3

from tests.twin.scene.overlays.states import EVERYTHING
from twin.scene.overlays.spread import InvalidCovarianceError, ellipsoid_95, enlargement
from twin.scene.scene import TwinScene

sigmas = st.floats(0.01, 50)
angles = st.floats(-3, 3)


@given(st.tuples(sigmas, sigmas, sigmas), angles, angles, angles)
def test_its_axes_are_those_of_the_covariance(
    sigma: tuple[float, float, float], roll: float, pitch: float, yaw: float
) -> None:
    turn = SO3.from_rpy_radians(roll, pitch, yaw).as_matrix()
    covariance = turn @ np.diag(np.square(sigma)) @ turn.T
    half_axes, rotation = ellipsoid_95(covariance)
    assert half_axes == pytest.approx(sorted(2.795483 * np.array(sigma))[::-1], rel=1e-5)
    assert np.linalg.det(rotation) == pytest.approx(1)
    rebuilt = rotation @ np.diag(np.square(half_axes) / 7.814728) @ rotation.T
    assert rebuilt == pytest.approx(covariance, rel=1e-5, abs=1e-6 * max(sigma) ** 2)


def test_it_holds_19_of_20_points() -> None:
    covariance = np.array([[4.0, 1.5, 0.2], [1.5, 2.0, -0.4], [0.2, -0.4, 9.0]])
    points = np.random.default_rng(11).multivariate_normal(np.zeros(3), covariance, 200_000)
    half_axes, rotation = ellipsoid_95(covariance)
    inside = np.linalg.norm(points @ rotation / np.array(half_axes), axis=1) <= 1
    assert inside.mean() == pytest.approx(0.95, abs=0.002)  # four standard errors


@pytest.mark.parametrize(
    "wrong",
    [
        np.diag([1.0, -0.1, 1.0]),
        np.array([[1.0, 0.5, 0], [0.2, 1.0, 0], [0, 0, 1.0]]),
        np.diag([1.0, np.nan, 1.0]),
        np.diag([1.0, np.inf, 1.0]),
    ],
    ids=["negative", "not symmetric", "not a number", "infinite"],
)
def test_what_is_no_covariance_is_refused_and_named(scene: TwinScene, wrong: np.ndarray) -> None:
    with pytest.raises(InvalidCovarianceError, match="covariance"):
        ellipsoid_95(wrong)
    scene.show(EVERYTHING)
    scene.show(replace(EVERYTHING, socket_covariance_mm2=wrong))
    assert not scene.spread.place.visible
    assert scene.notice.visible
    assert "covariance" in scene.notice.text


def test_a_point_known_exactly_has_no_size() -> None:
    assert ellipsoid_95(np.zeros((3, 3))).half_axes_mm == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("half_axis_mm", "factor"), [(30.0, 1), (12.0, 1), (11.9, 2), (1.4, 10), (0.2, 100), (0.0, 100)]
)
def test_it_is_enlarged_until_it_is_seen(half_axis_mm: float, factor: int) -> None:
    assert enlargement(half_axis_mm) == factor


def test_words_give_its_true_size_and_its_enlargement(scene: TwinScene) -> None:
    scene.show(EVERYTHING)
    assert scene.spread.place.visible
    # 2.795 times 0.5, 0.3 and 0.2 mm.
    assert scene.spread.label.text == "± 1.40, 0.84, 0.56 mm (drawn 10 x)"
    assert np.asarray(scene.spread.ellipsoid.scale) == pytest.approx([13.98, 8.39, 5.59], abs=0.01)
    scene.show(replace(EVERYTHING, T_base_socket=None))
    assert not scene.spread.place.visible
