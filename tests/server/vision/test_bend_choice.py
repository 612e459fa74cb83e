"""Which part of a bent label is flat: where the picture does not say, the covariance does."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision import Gates, Locator
from server.vision.errors import AmbiguousTiltError, EdgesDoNotFitError
from server.vision.fitting.bend_choice import BendChoice, chosen_bend
from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.edge_fit import fit_edges
from server.vision.fitting.robust_step import RobustStep
from server.vision.projection import Array
from tests.server.vision.label_shots import CAMERA, LABEL, MODULES, SIZE_MM, shot_of
from tests.server.vision.pictures import pose, pose_error
from tests.support.label_pictures import Placed, photograph
from tests.support.picture_taking import Shot

PLACE = pose((6.0, -4.0, 280.0), (4.0, -5.0, 8.0))
NOISY = Shot(full_well=200.0, read_noise=0.03)
CREASED = Placed(LABEL, PLACE, lift_mm=1.8, crease=-0.2)
"""Loose from beyond the middle on: the other corner looks loose about as well."""
MISCHOSEN = 8
"""Seed of a picture in which the wrong corner explains the noise better."""

CHI2_9999_OF_SIX = 27.86
COUNT = 200


def left(residuals: Array, turn_rad: float) -> RobustStep:
    """A step that turns the label about x and leaves some residuals."""
    step = np.zeros(7)
    step[0] = turn_rad
    return RobustStep(
        step=step,
        design=np.zeros((COUNT, 7)),
        residuals=residuals,
        weights=np.ones(COUNT),
        scale_px=np.full(COUNT, 0.1),
        used=np.ones(COUNT, dtype=np.bool_),
        efficiency=1.0,
    )


def one_bend(flat: RobustStep, bent: RobustStep) -> BendChoice:
    return chosen_bend([np.zeros((4, COUNT))], flat, lambda _: bent)


def test_bends_that_fit_alike_put_their_distance_into_the_covariance() -> None:
    noise = np.full(COUNT, 0.1)
    steps = {1.0: left(noise, 0.02), 2.0: left(noise, -0.02), 3.0: left(2 * noise, 0.5)}
    bends = [np.full((4, COUNT), mark) for mark in steps]
    choice = chosen_bend(bends, left(3 * noise, 0.3), lambda bend: steps[float(bend[0, 0])])
    assert choice.by_heights is bends[0]
    # Two of equal weight, 0.04 apart; those that fit badly are far off and count for nothing.
    assert choice.doubt[0, 0] == pytest.approx(0.5 * 0.04**2, rel=1e-6)
    assert np.count_nonzero(choice.doubt) == 1


def test_a_bend_must_explain_more_than_its_unknowns_do_by_chance() -> None:
    noise = np.full(COUNT, 0.1)
    for share, is_bent in ((0.95, False), (0.9, True)):  # of chi^2, which is 200
        choice = one_bend(left(noise, 0.0), left(noise * np.sqrt(share), 0.01))
        assert (choice.by_heights is not None) == is_bent
        assert 0 < choice.doubt[0, 0] < 0.5 * 0.01**2


def test_no_pose_is_sure_of_the_wrong_part_of_a_creased_label() -> None:
    """Alone, the covariance of the chosen bend promises 0.4 degrees; the pose is 1.6 off."""
    image = photograph(CAMERA, (CREASED,), NOISY, np.random.default_rng(MISCHOSEN))
    fit = fit_edges(image, CAMERA, code_edges(MODULES, SIZE_MM), PLACE)
    assert fit is not None
    error = pose_error(fit.T_camera_label, PLACE)
    assert error @ np.linalg.solve(fit.covariance, error) < CHI2_9999_OF_SIX
    strongly_bent = Gates(bend_modules=99.0)
    with pytest.raises(EdgesDoNotFitError, match="which part of it is flat") as caught:
        Locator(CAMERA, strongly_bent).locate(image, label_size_mm=SIZE_MM)
    assert caught.value.context["turn_sigma_deg"] > 0.5


def test_a_tilt_that_noise_leaves_open_is_no_matter_of_bends() -> None:
    with pytest.raises(AmbiguousTiltError, match="too little of the label's tilt"):
        Locator(CAMERA, Gates(turn_sigma_deg=0.001)).locate(shot_of(), label_size_mm=SIZE_MM)
