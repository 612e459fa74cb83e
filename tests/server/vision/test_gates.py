"""Every gate keeps out what it is for, with an error of its own."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision import Gates, Locator, PoseRejectedError, VisionError
from server.vision.errors import (
    AmbiguousLabelError,
    AmbiguousTiltError,
    EdgesDisagreeError,
    EdgesDoNotFitError,
    FitFailedError,
    ImplausibleDistanceError,
    ImplausibleTiltError,
    LabelCutOffError,
    MirroredCodeError,
    ModulesDisagreeError,
)
from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.edge_fit import EdgeFit, fit_edges
from server.vision.fitting.two_poses import fit_best
from server.vision.projection import Array
from tests.server.vision.label_shots import CAMERA, LABEL, MODULES, PLACE, SIZE_MM, shot_of
from tests.server.vision.pictures import PAYLOAD, pose, pose_error
from tests.support.label_pictures import Placed
from tests.support.label_prints import covered, dirty, mirrored, pasted_over, printed
from tests.support.picture_taking import Shot
from twin.qr_label import label_modules

Image = np.ndarray[tuple[int, int], np.dtype[np.uint8]]

CHI2_9999_OF_SIX = 27.86


def located(image: Image, gates: Gates | None = None) -> Array:
    """The pose of our label."""
    locator = Locator(CAMERA, gates)
    found = locator.locate(image, label_size_mm=SIZE_MM, expected_payload=PAYLOAD)
    return found.T_camera_label


def fitted(image: Image, T_start: Array = PLACE) -> EdgeFit:
    fit = fit_edges(image, CAMERA, code_edges(MODULES, SIZE_MM), T_start)
    assert fit is not None
    return fit


def test_a_good_picture_passes_them_all() -> None:
    error = pose_error(located(shot_of()), PLACE)
    assert np.abs(error[3:5]).max() < 0.005
    assert abs(error[5]) < 0.02


def test_a_mirrored_print_is_told() -> None:
    with pytest.raises(MirroredCodeError):
        located(shot_of(mirrored(LABEL)))


def test_a_copy_of_the_label_makes_it_ambiguous() -> None:
    beside = PLACE.copy()
    beside[:3, 3] = 70.0, 0.0, 330.0
    here = PLACE.copy()
    here[:3, 3] = -40.0, 0.0, 260.0
    copy = Placed(printed(MODULES, SIZE_MM), beside)
    with pytest.raises(AmbiguousLabelError) as caught:
        located(shot_of(LABEL, here, others=[copy]))
    assert caught.value.code == "label_ambiguous"
    other = Placed(printed(label_modules("PLUGPILOT:1:OTHER"), SIZE_MM), beside)
    error = pose_error(located(shot_of(LABEL, here, others=[other])), here)
    assert np.abs(error[3:5]).max() < 0.01


def test_a_label_that_comes_off_the_car_is_rejected() -> None:
    with pytest.raises(EdgesDoNotFitError, match="flat label"):
        located(shot_of(lift_mm=15.0))


@pytest.mark.parametrize(
    ("lift_mm", "bow_mm"), [(1.5, 0.0), (0.0, 0.8), (0.0, -0.8)], ids=["corner", "bow", "dent"]
)
def test_a_slight_bend_is_taken_out(lift_mm: float, bow_mm: float) -> None:
    """Fitted as if it were flat, it would be turned by twenty standard deviations."""
    locator = Locator(CAMERA)
    for seed in range(3):
        image = shot_of(lift_mm=lift_mm, bow_mm=bow_mm, seed=seed)
        found = locator.locate(image, label_size_mm=SIZE_MM)
        error = pose_error(found.T_camera_label, PLACE)
        assert np.hypot(error[3], error[4]) < 0.01
        assert np.degrees(np.hypot(error[0], error[1])) < 0.05
        assert error @ np.linalg.solve(found.covariance, error) < CHI2_9999_OF_SIX


def test_another_label_stuck_over_it_is_rejected() -> None:
    """The code is still read, by its error correction, but part of it is not ours."""
    other = printed(label_modules("PLUGPILOT:1:7F3K22Q8"), SIZE_MM)
    outcomes = []
    for seed in range(6):
        label = pasted_over(LABEL, other, np.random.default_rng(seed), 0.2)
        try:
            error = pose_error(located(shot_of(label)), PLACE)
        except VisionError as refusal:
            outcomes.append(refusal.code)
        else:
            outcomes.append("located")
            assert np.abs(error[3:5]).max() < 0.1  # the sound part decided
    assert any(code not in {"located", "no_code"} for code in outcomes), outcomes


def test_noise_beyond_measure_is_rejected() -> None:
    with pytest.raises(EdgesDoNotFitError, match="px off"):
        located(shot_of(), Gates(rms_px=0.001, rms_modules=0.0001))


def test_a_half_hidden_code_is_rejected_though_it_is_known() -> None:
    """In tracking nobody reads the code: the share of agreeing edges tells."""
    half = covered(LABEL, np.random.default_rng(2), 0.35)
    image = shot_of(half)
    fit = fitted(image)
    with pytest.raises((EdgesDisagreeError, EdgesDoNotFitError)):
        Gates().check_fit(fit, image, CAMERA, MODULES, SIZE_MM)
    with pytest.raises(EdgesDisagreeError, match="of the edges agree") as caught:
        Gates(bow_modules=99.0).check_fit(fit, image, CAMERA, MODULES, SIZE_MM)
    assert caught.value.context["inlier_share"] < 0.82


def test_other_modules_in_the_same_place_are_noticed() -> None:
    """Edges of another code that happen to lie on the same grid do not make it ours."""
    image = shot_of()
    stranger = label_modules("PLUGPILOT:1:7F3K22Q8")
    with pytest.raises(ModulesDisagreeError, match="of the modules") as caught:
        Gates().check_fit(fitted(image), image, CAMERA, stranger, SIZE_MM)
    assert caught.value.code == "modules_disagree"


def test_distance_and_tilt_must_be_possible() -> None:
    image = shot_of()
    with pytest.raises(ImplausibleDistanceError, match="230 mm away"):
        located(image, Gates(nearest_mm=250.0))
    with pytest.raises(ImplausibleDistanceError):
        located(image, Gates(farthest_mm=200.0))
    with pytest.raises(ImplausibleTiltError) as caught:
        located(image, Gates(tilt_deg=3.0))
    assert caught.value.context["tilt_deg"] == pytest.approx(6.4, abs=2.0)
    nowhere = PLACE.copy()
    nowhere[2, 3] = np.nan
    with pytest.raises(ImplausibleDistanceError):
        Gates().check_pose(nowhere, CAMERA, SIZE_MM)


def test_a_label_at_the_border_is_told() -> None:
    beyond = PLACE.copy()
    beyond[0, 3] = 95.0
    with pytest.raises(LabelCutOffError):
        Gates().check_pose(beyond, CAMERA, SIZE_MM)


def test_a_tilt_that_could_be_the_opposite_is_rejected() -> None:
    """Far away, with little light, the picture fits both ways."""
    far = pose((0.0, 0.0, 600.0), (5.0, 0.0, 0.0))
    opposite = pose((0.0, 0.0, 600.0), (-5.0, 0.0, 0.0))
    edges = code_edges(MODULES, SIZE_MM)
    outcomes = []
    for seed in range(16):
        noisy = Shot(blur_px=0.8, full_well=3.0, read_noise=0.1)
        image = shot_of(LABEL, far, shot=noisy, seed=seed)
        try:
            fit = fit_best(image, CAMERA, edges, [opposite, far])
        except AmbiguousTiltError:
            outcomes.append("ambiguous")
        except FitFailedError:
            outcomes.append("failed")
        else:
            turn = np.degrees(pose_error(fit.T_camera_label, far)[0])
            if fit.rms_px > Gates().rms_px:
                outcomes.append("too noisy")
                continue
            outcomes.append("right" if abs(turn) < 5.0 else "wrong")  # the opposite is 10 off
    assert "ambiguous" in outcomes, outcomes
    assert "wrong" not in outcomes, outcomes


def test_near_enough_both_starts_lead_to_the_right_tilt() -> None:
    edges = code_edges(MODULES, SIZE_MM)
    true = pose((5.0, 3.0, 420.0), (9.0, 0.0, 5.0))
    opposite = pose((5.0, 3.0, 420.0), (-9.0, 0.0, 5.0))
    image = shot_of(LABEL, true)
    for starts in ([opposite, true], [true, opposite], [opposite]):
        fit = fit_best(image, CAMERA, edges, starts)
        assert np.degrees(np.abs(pose_error(fit.T_camera_label, true)[:2]).max()) < 0.2


def test_dirt_does_not_pull_the_pose() -> None:
    rng = np.random.default_rng(4)
    label = dirty(LABEL, rng, 15)
    error = pose_error(located(shot_of(label)), PLACE)
    assert np.abs(error[3:5]).max() < 0.02
    assert abs(error[5]) < 0.1


def test_every_rejection_is_one_kind() -> None:
    kinds = PoseRejectedError.__subclasses__()
    codes = {kind.code for kind in kinds}
    assert len(codes) == len(kinds) == 10
    assert all(kind.remedy.endswith(".") for kind in kinds)
