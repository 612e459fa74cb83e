"""The locator against pictures with known poses."""

from __future__ import annotations

import numpy as np
import pytest
import segno

from drivers.camera import CameraModel
from drivers.simulator.camera.conditions import Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.renderer import Renderer
from server.vision import Gates, Locator, PoseSource
from server.vision.errors import (
    EdgesDisagreeError,
    EdgesDoNotFitError,
    FitFailedError,
    ImageSizeMismatchError,
    InvalidLabelSizeError,
    LabelJumpedError,
    MirroredCodeError,
    NoCodeError,
    PoseRejectedError,
    WrongPayloadError,
)
from server.vision.fitting.start_pose import StartPose, start_poses
from server.vision.markers.code import Code, Image
from server.vision.markers.qr_codes import QrCodes
from server.vision.projection import Array, perturbed
from tests.server.vision.pictures import (
    OPTICS,
    PAYLOAD,
    SIZE_MM,
    flat_code,
    picture,
    pose,
    pose_error,
    random_pose,
    view,
)

HEAD_ON = pose((3.0, -4.0, 290.0), (1.0, -1.5, 180.0))


@pytest.mark.parametrize(
    ("nearest_mm", "farthest_mm", "lateral_mm", "depth_mm", "tilt_deg"),
    [
        (110.0, 160.0, 0.002, 0.02, 0.04),
        (160.0, 300.0, 0.003, 0.02, 0.04),
        (300.0, 450.0, 0.012, 0.04, 0.06),
        (450.0, 600.0, 0.025, 0.12, 0.12),
    ],
)
def test_poses_are_accurate_at_all_distances(
    nearest_mm: float, farthest_mm: float, lateral_mm: float, depth_mm: float, tilt_deg: float
) -> None:
    rng = np.random.default_rng(int(nearest_mm))
    locator = Locator(OPTICS)
    for number in range(8):
        true = random_pose(rng, nearest_mm, farthest_mm)
        found = locator.locate(picture(view(true), number), label_size_mm=SIZE_MM)
        assert found.payload == PAYLOAD
        assert found.source is PoseSource.EDGES
        error = pose_error(found.T_camera_label, true)
        assert np.hypot(error[3], error[4]) < lateral_mm
        assert abs(error[5]) < depth_mm
        assert np.degrees(np.hypot(error[0], error[1])) < tilt_deg


@pytest.mark.parametrize("tilt_deg", [(25.0, 0.0, 10.0), (0.0, -35.0, 0.0), (20.0, 20.0, 200.0)])
def test_oblique_labels_are_located(tilt_deg: tuple[float, float, float]) -> None:
    true = pose((10.0, 5.0, 320.0), tilt_deg)
    found = Locator(OPTICS).locate(picture(view(true)), label_size_mm=SIZE_MM)
    error = pose_error(found.T_camera_label, true)
    assert np.abs(error[3:5]).max() < 0.02
    assert abs(error[5]) < 0.05
    assert np.degrees(np.abs(error[:3]).max()) < 0.06


def test_the_opposite_tilt_is_not_taken_for_the_right_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """Far away both poses of the corners lead to a fit; the picture decides which is right."""
    true = pose((40.0, -30.0, 620.0), (12.0, 0.0, 5.0))
    image = picture(view(true))

    def wrong_way_round(camera: CameraModel, corners_px: Array, size_mm: float) -> list[StartPose]:
        return start_poses(camera, corners_px, size_mm)[::-1]

    monkeypatch.setattr("server.vision.locator.start_poses", wrong_way_round)
    found = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM)
    assert np.degrees(np.abs(pose_error(found.T_camera_label, true)[:3]).max()) < 0.3


def test_the_covariance_is_honest() -> None:
    """Squared errors over their promised variance average to one, in all six directions."""
    rng = np.random.default_rng(3)
    locator = Locator(OPTICS)
    normalised = []
    chi2 = []
    for number in range(60):
        true = random_pose(rng, 200.0, 450.0)
        found = locator.locate(picture(view(true), number), label_size_mm=SIZE_MM)
        error = pose_error(found.T_camera_label, true)
        normalised.append(error / np.sqrt(np.diag(found.covariance)))
        chi2.append(error @ np.linalg.solve(found.covariance, error))
    rms = np.sqrt(np.mean(np.square(normalised), axis=0))
    assert np.all(rms > 0.4), rms
    assert np.all(rms < 1.6), rms
    # chi^2 of six degrees of freedom has the mean 6; of 60 of them, 4.9 to 7.2 at 99 percent.
    # The room below is for the floor of the depth, the room above for shading.
    assert 3.5 < float(np.mean(chi2)) < 8.0


@pytest.mark.parametrize("speed_mm_s", [2.0, 30.0, 90.0])
def test_a_moving_label_is_located_where_it_is_in_the_middle_of_the_exposure(
    speed_mm_s: float,
) -> None:
    """A sensor that reads row by row shears what moves; the fit takes that out."""
    scene = view(HEAD_ON, velocity_mm_s=(speed_mm_s, -0.4 * speed_mm_s, 0.0))
    image = picture(scene)
    locator = Locator(OPTICS)
    found = locator.locate(image, label_size_mm=SIZE_MM, moving=True)
    assert np.abs(pose_error(found.T_camera_label, HEAD_ON)[3:5]).max() < 0.03
    again = locator.locate(image, label_size_mm=SIZE_MM, predicted=HEAD_ON, moving=True)
    assert np.abs(pose_error(again.T_camera_label, HEAD_ON)[3:5]).max() < 0.03


@pytest.mark.parametrize("place", [(-90.0, 40.0, 300.0), (100.0, -60.0, 300.0)])
def test_a_bowed_label_that_could_move_but_stands_is_as_far_away(
    place: tuple[float, float, float],
) -> None:
    """Shear, tilt and bow look alike beside the axis: each needs unknowns of its own."""
    bowed = Renderer(OPTICS, ImagingParameters(), seed=3, conditions=Conditions())
    assert abs(bowed.label_condition.bow_mm) > 0.1
    image = bowed.picture(view(pose(place, (2.0, -3.0, 1.0))), 1)
    still = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM)
    free = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM, moving=True)
    depths_mm = still.T_camera_label[2, 3], free.T_camera_label[2, 3]
    assert depths_mm[1] == pytest.approx(depths_mm[0], rel=5e-4)


def test_a_wrong_label_size_scales_the_pose_and_nothing_else() -> None:
    image = picture(view(HEAD_ON))
    right = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM)
    wrong = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM * 1.02)
    np.testing.assert_allclose(
        wrong.T_camera_label[:3, 3], right.T_camera_label[:3, 3] * 1.02, rtol=1e-5
    )
    np.testing.assert_allclose(
        wrong.T_camera_label[:3, :3], right.T_camera_label[:3, :3], atol=1e-5
    )


@pytest.mark.parametrize(
    ("version", "error", "mask"), [(1, "l", 0), (2, "h", 5), (3, "m", 2), (6, "q", 7)]
)
def test_labels_made_elsewhere_are_located(version: int, error: str, mask: int) -> None:
    made = segno.make("car 42", version=version, error=error, mask=mask, boost_error=False)
    modules = np.array(made.matrix, dtype=np.bool_)
    module_px = 8
    flat = flat_code(modules, module_px)
    image = np.full((480, 640), 230, dtype=np.uint8)
    image[20 : 20 + len(flat), 30 : 30 + len(flat)] = flat
    camera = CameraModel(width=640, height=480, fx=600.0, fy=600.0, cx=319.5, cy=239.5)
    found = Locator(camera).locate(image, label_size_mm=SIZE_MM)
    assert found.payload == "car 42"
    assert found.source is PoseSource.EDGES
    side_px = len(modules) * module_px
    z_mm = 600.0 * SIZE_MM / side_px
    middle_px = (4 * module_px + side_px / 2 - 0.5) + np.array((30, 20))
    lateral_mm = (middle_px - (319.5, 239.5)) * z_mm / 600.0
    np.testing.assert_allclose(found.T_camera_label[:3, 3], (*lateral_mm, z_mm), atol=0.01)
    np.testing.assert_allclose(found.T_camera_label[:3, :3], np.eye(3), atol=1e-3)


def test_white_on_black_is_located() -> None:
    image = 255 - picture(view(HEAD_ON), illumination_gradient=0.0)
    found = Locator(OPTICS).locate(image, label_size_mm=SIZE_MM)
    assert np.abs(pose_error(found.T_camera_label, HEAD_ON)[3:]).max() < 0.05


def test_a_prediction_saves_decoding_but_not_accuracy(monkeypatch: pytest.MonkeyPatch) -> None:
    locator = Locator(OPTICS)
    locator.locate(picture(view(HEAD_ON)), label_size_mm=SIZE_MM)
    monkeypatch.setattr(locator, "read", _must_not_be_called)
    moved = perturbed(HEAD_ON, np.array([0.01, -0.02, 0.005, 0.6, -0.5, 1.5]))
    found = locator.locate(picture(view(moved), 1), label_size_mm=SIZE_MM, predicted=HEAD_ON)
    assert np.abs(pose_error(found.T_camera_label, moved)[3:5]).max() < 0.01


def _must_not_be_called(*_: object, **__: object) -> None:
    pytest.fail("the code was decoded although it was predicted")


def test_a_wrong_prediction_is_noticed_and_the_picture_searched() -> None:
    """Off by one module sideways the fit would settle on the neighbours' edges."""
    locator = Locator(OPTICS, Gates(jump_mm=100.0))
    image = picture(view(HEAD_ON))
    locator.locate(image, label_size_mm=SIZE_MM)
    module_mm = SIZE_MM / 29
    for shift in ((module_mm, 0.0, 0.0), (0.0, -2 * module_mm, 0.0), (40.0, 30.0, 25.0)):
        predicted = HEAD_ON.copy()
        predicted[:3, 3] += shift
        found = locator.locate(image, label_size_mm=SIZE_MM, predicted=predicted)
        assert np.abs(pose_error(found.T_camera_label, HEAD_ON)[3:5]).max() < 0.01


def test_predictions_are_trusted_only_so_often_in_a_row() -> None:
    """After some fits the code is read again near its place, and in time in the whole picture."""
    marker = CountedQrCodes()
    locator = Locator(OPTICS, Gates(tracked_fits=2, near_reads=1), marker)
    image = picture(view(HEAD_ON))
    for _ in range(11):
        locator.locate(image, label_size_mm=SIZE_MM, predicted=HEAD_ON)
    assert marker.reads == ["all", "near", "all", "near", "all"]


class CountedQrCodes(QrCodes):
    """QR codes that note where they were looked for."""

    def __init__(self) -> None:
        self.reads: list[str] = []

    def find(self, image: Image, *, wanted: str | None = None) -> list[Code]:
        self.reads.append("all")
        return super().find(image, wanted=wanted)

    def find_near(self, image: Image, corners_px: Array, wanted: str) -> Code | None:
        self.reads.append("near")
        return super().find_near(image, corners_px, wanted)


def test_a_label_that_jumped_is_rejected() -> None:
    image = picture(view(HEAD_ON))
    for jump in ((30.0, 0.0, 0.0), (0.0, 10.0, 28.0)):
        predicted = HEAD_ON.copy()
        predicted[:3, 3] += jump
        with pytest.raises(LabelJumpedError) as caught:
            Locator(OPTICS).locate(image, label_size_mm=SIZE_MM, predicted=predicted)
        assert caught.value.code == "label_jumped"
        assert caught.value.context["jump_mm"] == pytest.approx(np.linalg.norm(jump), abs=0.05)


def test_a_prediction_of_another_label_does_not_hide_the_expected_one() -> None:
    locator = Locator(OPTICS)
    other = view(HEAD_ON, payload="PLUGPILOT:1:OTHER")
    locator.locate(picture(other), label_size_mm=SIZE_MM)
    found = locator.locate(
        picture(view(HEAD_ON)), label_size_mm=SIZE_MM, expected_payload=PAYLOAD, predicted=HEAD_ON
    )
    assert found.payload == PAYLOAD


def test_the_expected_label_is_chosen_among_several() -> None:
    image = picture(view(HEAD_ON))
    big = flat_code(np.array(segno.make("other", micro=False).matrix, dtype=np.bool_), 18)
    image[10 : 10 + len(big), 10 : 10 + len(big)] = big
    locator = Locator(OPTICS)
    assert locator.locate(image, label_size_mm=SIZE_MM).payload == "other"
    found = locator.locate(image, label_size_mm=SIZE_MM, expected_payload=PAYLOAD)
    assert np.abs(pose_error(found.T_camera_label, HEAD_ON)[3:5]).max() < 0.01


def test_no_code_is_an_error() -> None:
    gone = view(pose((0.0, 0.0, 50_000.0)))
    with pytest.raises(NoCodeError) as caught:
        Locator(OPTICS).locate(picture(gone), label_size_mm=SIZE_MM)
    assert caught.value.code == "no_code"


def test_another_label_than_the_expected_is_an_error_that_names_both() -> None:
    with pytest.raises(WrongPayloadError, match="my car") as caught:
        Locator(OPTICS).locate(
            picture(view(HEAD_ON)), label_size_mm=SIZE_MM, expected_payload="my car"
        )
    assert caught.value.code == "wrong_payload"
    assert caught.value.context == {"expected": "my car", "found": [PAYLOAD]}


def test_a_mirrored_label_is_rejected() -> None:
    image = np.ascontiguousarray(picture(view(HEAD_ON))[:, ::-1])
    with pytest.raises(MirroredCodeError) as caught:
        Locator(OPTICS).locate(image, label_size_mm=SIZE_MM)
    assert isinstance(caught.value, PoseRejectedError)
    assert caught.value.code == "mirrored_code"


def test_a_bent_label_is_rejected_but_has_a_coarse_pose() -> None:
    image = picture(view(HEAD_ON))
    rows = np.arange(image.shape[0])
    shift = np.round(4 * np.sin((rows - 616.0) / 60.0)).astype(int)
    columns = np.clip(np.arange(image.shape[1]) + shift[:, None], 0, image.shape[1] - 1)
    bent = np.take_along_axis(image, columns, axis=1)
    locator = Locator(OPTICS)
    with pytest.raises(PoseRejectedError) as caught:
        locator.locate(bent, label_size_mm=SIZE_MM)
    assert isinstance(caught.value, EdgesDoNotFitError | EdgesDisagreeError | FitFailedError)
    coarse = locator.coarse(locator.read(bent), SIZE_MM)
    assert coarse.source is PoseSource.CORNERS
    error = pose_error(coarse.T_camera_label, HEAD_ON)
    assert np.all(np.abs(error) < 4 * np.sqrt(np.diag(coarse.covariance)))
    assert coarse.translation_sigma_mm[2] > 0.3


def test_a_picture_of_another_resolution_is_an_error() -> None:
    with pytest.raises(ImageSizeMismatchError, match="640 x 480") as caught:
        Locator(OPTICS).locate(np.zeros((480, 640), dtype=np.uint8), label_size_mm=SIZE_MM)
    assert caught.value.code == "resolution_mismatch"


@pytest.mark.parametrize("size_mm", [0.0, -60.0, 4.9, 1001.0, float("nan"), float("inf")])
def test_a_label_must_have_a_possible_size(size_mm: float) -> None:
    with pytest.raises(InvalidLabelSizeError, match="give 5 to 1000 mm") as caught:
        Locator(OPTICS).locate(picture(view(HEAD_ON)), label_size_mm=size_mm)
    assert caught.value.code == "invalid_label_size"


def test_a_colour_picture_is_a_mistake() -> None:
    with pytest.raises(ValueError, match="grey"):
        Locator(OPTICS).locate(np.zeros((1232, 1640, 3), dtype=np.uint8), label_size_mm=SIZE_MM)


def test_a_prediction_does_not_lead_to_the_opposite_tilt() -> None:
    """From the wrong side the edges are matched, too; only the reading tells."""
    true = pose((10.0, 5.0, 560.0), (7.0, 0.0, 180.0))
    image = picture(view(true))
    locator = Locator(OPTICS, Gates(jump_deg=30.0))
    locator.locate(image, label_size_mm=SIZE_MM)
    for tilt_deg in (-7.0, -4.0, 3.0):
        predicted = pose((10.0, 5.0, 560.0), (tilt_deg, 0.0, 180.0))
        found = locator.locate(image, label_size_mm=SIZE_MM, predicted=predicted)
        assert np.degrees(np.abs(pose_error(found.T_camera_label, true)[:2]).max()) < 0.3
