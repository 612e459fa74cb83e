"""What each effect does to the pose of the label, through the real locator.

The orders of magnitude are those of independent measurements with another renderer: a label bowed
by 0.3 mm turns its pose by 0.14 to 0.18 degrees and moves it by 0.16 to 0.22 mm in depth; a print
larger by 0.3% seems nearer by 0.3%.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from drivers.camera import pi_camera_v2
from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.label_condition import LabelCondition
from drivers.simulator.camera.renderer import Renderer
from server.vision import Locator, VisionError
from tests.drivers.simulator.camera.scenes import PAYLOAD, SIZE_MM, pose, scenes, view

TRUE = pose(4.0, -9.0, 280.0, (0.02, -0.03, 0.01))
SEED = 3


@cache
def locator() -> Locator:
    return Locator(pi_camera_v2())


def pose_error(
    imaging: ImagingParameters,
    conditions: Conditions = FLAWLESS,
    velocity_mm_s: tuple[float, float, float] = (0.0, 0.0, 0.0),
    label: LabelCondition | None = None,
    true: np.ndarray = TRUE,
) -> tuple[float, float, float]:
    """Lateral [mm], depth [mm] and turn [degrees] that one picture is off."""
    renderer = Renderer(pi_camera_v2(), imaging, SEED, conditions)
    if label is not None:
        renderer.draw_label(label)
    image = renderer.picture(view(true, velocity_mm_s=velocity_mm_s), 0)
    found = locator().locate(image, label_size_mm=SIZE_MM, expected_payload=PAYLOAD)
    moved = found.T_camera_label[:3, 3] - true[:3, 3]
    cosine = (np.trace(found.T_camera_label[:3, :3].T @ true[:3, :3]) - 1) / 2
    turn_deg = math.degrees(math.acos(min(float(cosine), 1.0)))
    return float(np.hypot(moved[0], moved[1])), float(moved[2]), turn_deg


def test_a_flawless_label_is_located_to_a_few_micrometres() -> None:
    lateral_mm, depth_mm, turn_deg = pose_error(ImagingParameters())
    assert lateral_mm < 0.01
    assert abs(depth_mm) < 0.05
    assert turn_deg < 0.06


@pytest.fixture
def believed_flat(monkeypatch: pytest.MonkeyPatch) -> None:
    """The locator does not look for bends, as those who measured elsewhere did not."""
    monkeypatch.setattr("server.vision.fitting.bending.EDGES_FOR_BEND", 10**6)


@pytest.mark.usefixtures("believed_flat")
def test_a_bowed_label_is_turned_and_moved_as_measured_elsewhere() -> None:
    turns, depths = [], []
    for x, y, bow in ((40.0, 20.0, 0.3), (-40.0, 20.0, 0.3), (30.0, -30.0, -0.3)):
        true = pose(x, y, 280.0, (0.02, -0.03, 0.01))
        bowed = LabelCondition(bow_mm=bow)
        _, depth_mm, turn_deg = pose_error(ImagingParameters(), label=bowed, true=true)
        depths.append(abs(depth_mm))
        turns.append(turn_deg)
    assert 0.05 < float(np.mean(turns)) < 0.4
    assert 0.08 < float(np.mean(depths)) < 0.4


@pytest.mark.parametrize("scale", [1.003, 0.99])
def test_a_wrong_print_size_is_a_wrong_depth(scale: float) -> None:
    printed = LabelCondition(width_scale=scale, height_scale=scale)
    _, depth_mm, _ = pose_error(ImagingParameters(), label=printed)
    assert depth_mm == pytest.approx(280.0 * (1 / scale - 1), abs=0.06)


def test_a_bow_that_is_looked_for_turns_nothing() -> None:
    """The depth is that of the plane that touches the middle, which stands off by the bow."""
    _, depth_mm, turn_deg = pose_error(ImagingParameters(), label=LabelCondition(bow_mm=0.3))
    assert depth_mm == pytest.approx(-0.3, abs=0.1)
    assert turn_deg < 0.06


@pytest.mark.usefixtures("believed_flat")
def test_a_lifted_corner_turns_the_label() -> None:
    lifted = LabelCondition(lifted_mm=1.0, lifted_corner=(1, 1))
    assert pose_error(ImagingParameters(), label=lifted)[2] > 0.05


def test_rolling_shutter_shifts_a_moving_label_by_its_row_and_shears_it() -> None:
    """A label above the middle of the picture is seen before the frame's own time."""
    true = pose(0.0, -60.0, 280.0)
    row = 615.5 - 60.0 / 280.0 * pi_camera_v2().fy
    early_s = (row / 1231 - 0.5) * 0.0233
    renderer = Renderer(pi_camera_v2(), ImagingParameters(), SEED)
    image = renderer.picture(view(true, velocity_mm_s=(80.0, 0.0, 0.0)), 0)
    found = locator().locate(image, label_size_mm=SIZE_MM, expected_payload=PAYLOAD)
    assert found.T_camera_label[0, 3] == pytest.approx(80.0 * early_s, abs=0.08)
    assert early_s < -0.004


def test_motion_alone_moves_nothing() -> None:
    without = ImagingParameters(readout_s=0.0)
    assert pose_error(without, velocity_mm_s=(80.0, 0.0, 0.0))[0] < 0.05


@pytest.mark.parametrize(
    ("scene", "worst_lateral_mm", "worst_depth_mm"),
    [
        ("Ordinary garage", 0.05, 0.5),
        ("Night, with the robot's own light", 0.05, 0.5),
        ("Rain", 0.08, 0.6),
        ("Glare of a low lamp", 0.05, 0.5),
        ("Automatic exposure", 0.05, 0.5),
    ],
)
def test_scenes_that_can_be_located(
    scene: str, worst_lateral_mm: float, worst_depth_mm: float
) -> None:
    parameters = scenes()[scene]
    lateral_mm, depth_mm, turn_deg = pose_error(parameters.imaging, parameters.conditions)
    assert lateral_mm < worst_lateral_mm
    assert abs(depth_mm) < worst_depth_mm
    assert turn_deg < 0.6


def test_a_label_that_is_half_covered_is_never_located_wrongly() -> None:
    label = FLAWLESS.label.model_copy(update={"covered": 0.45})
    with pytest.raises(VisionError):
        pose_error(ImagingParameters(), FLAWLESS.model_copy(update={"label": label}))


def test_the_readme_shows_a_scene_for_every_group() -> None:
    assert {
        "Ordinary garage",
        "Night, with the robot's own light",
        "Rain",
        "Glare of a low lamp",
        "Dirty label, partly covered",
        "Badly printed and badly stuck on",
        "Automatic exposure",
    } <= set(scenes())
