"""What one picture says, on pictures of the simulated camera."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import pytest

from drivers.camera import Frame
from server.guidance.finder_patterns import finder_patterns, unread_module_px
from server.guidance.model import Sighting, Unseen
from server.guidance.sight import CORNERS_EVERY, LabelSight
from server.localisation.frames import Pose, base_from_camera
from server.schema.vehicles import Vehicle
from tests.server.guidance.cars import SETTINGS
from tests.support.garage import Scene, on_scene
from twin.qr_label import label_modules


@dataclass
class Shot:
    """A picture, where it was taken, and what is so."""

    frame: Frame
    T_base_camera: Pose
    vehicles: list[Vehicle]
    truth_mm: np.ndarray

    def look(self, image: np.ndarray | None = None, *, times: int = 1) -> Sighting | Unseen:
        """What a new pair of eyes says in the end."""
        sight = LabelSight(SETTINGS.camera.optics, SETTINGS.geometry)
        for _ in range(times):
            found = sight.look(
                self.frame.image if image is None else image,
                self.frame.captured_at_s,
                self.T_base_camera,
                self.vehicles,
                None,
            )
        return found


@pytest.fixture(scope="module")
def shot() -> Shot:
    """The parked car of a garage."""

    async def scenario(scene: Scene) -> Shot:
        frame = await scene.garage.camera.frame()
        services = scene.services
        joints = services.supervisor.telemetry.joints_at(frame.captured_at_s)
        camera = base_from_camera(
            services.settings.geometry, services.settings.camera.mount, joints
        )
        truth = scene.truth().T_base_socket[:3, 3]
        return Shot(frame, camera, await services.vehicles.all(), truth)

    return on_scene(scenario, seed=3)


def test_a_known_label_gives_the_socket(shot: Shot) -> None:
    found = shot.look()
    assert isinstance(found, Sighting)
    assert np.all(np.abs(found.place_mm - shot.truth_mm) < (1.0, 2.0, 1.5))
    assert not found.flawed
    assert np.all(np.linalg.eigvalsh(found.lean_covariance) > 0)


@pytest.mark.parametrize(("faces", "seen"), [("robot", True), ("away", False), (None, None)])
def test_a_sighting_knows_how_its_vehicle_comes_in(
    shot: Shot, faces: str | None, seen: bool | None
) -> None:
    vehicles = [v.model_copy(update={"driver_faces": faces}) for v in shot.vehicles]
    found = Shot(shot.frame, shot.T_base_camera, vehicles, shot.truth_mm).look()
    assert isinstance(found, Sighting)
    assert found.faces_robot is seen


def test_labels_of_nobody_known_here(shot: Shot) -> None:
    vehicles = [
        v.model_copy(update={"label_payload": "PP2:other:AAAAAAAAAA"}) for v in shot.vehicles
    ]
    other = Shot(shot.frame, shot.T_base_camera, vehicles, shot.truth_mm)
    assert other.look() is Unseen.OTHER_LABEL
    assert Shot(shot.frame, shot.T_base_camera, [], shot.truth_mm).look() is Unseen.NO_VEHICLE


def test_the_same_label_twice(shot: Shot) -> None:
    image = np.asarray(shot.frame.image)
    label = image[:, : image.shape[1] // 2]
    twice = np.hstack((label, label))[:, : image.shape[1]]
    assert shot.look(np.ascontiguousarray(twice)) is Unseen.TWICE


def test_a_mirrored_label(shot: Shot) -> None:
    assert shot.look(np.ascontiguousarray(shot.frame.image[:, ::-1])) is Unseen.MIRRORED


def test_no_light_too_much_light_and_nothing(shot: Shot) -> None:
    shape = shot.frame.image.shape
    assert shot.look(np.full(shape, 5, np.uint8)) is Unseen.TOO_DARK
    assert shot.look(np.full(shape, 255, np.uint8)) is Unseen.TOO_BRIGHT
    noise = np.random.default_rng(1).normal(120, 2, shape).clip(0, 255).astype(np.uint8)
    assert shot.look(noise, times=2) is Unseen.NOTHING


def a_code(module_px: int) -> np.ndarray:
    """A sharp drawing of a label without its quiet zone's surroundings."""
    modules = label_modules("PP2:zoe:4NG43RRFJW")
    drawn = np.pad(np.where(modules, 30, 220).astype(np.uint8), 4, constant_values=220)
    return np.kron(drawn, np.ones((module_px, module_px), np.uint8))


@pytest.mark.parametrize("module_px", [3, 6, 11])
def test_corners_of_codes_are_found_and_measured(module_px: int) -> None:
    image = cv2.GaussianBlur(np.pad(a_code(module_px), 60, constant_values=140), (0, 0), 0.8)
    assert len(finder_patterns(np.asarray(image, np.uint8))) == 3
    found = unread_module_px(np.asarray(image, np.uint8))
    assert found == pytest.approx(module_px, rel=0.15)


def test_nested_squares_alone_are_no_code() -> None:
    image = np.full((400, 600), 200, np.uint8)
    for side, grey in ((140, 20), (100, 210), (60, 20)):
        low, high = 200 - side // 2, 200 + side // 2
        image[low:high, low:high] = grey
    assert len(finder_patterns(image)) == 1
    assert unread_module_px(image) is None


def test_a_label_with_a_leaf_on_it_is_called_unreadable(shot: Shot) -> None:
    found = shot.look()
    assert isinstance(found, Sighting)
    image = np.asarray(shot.frame.image).copy()
    to_label = np.linalg.inv(shot.T_base_camera) @ found.T_base_label
    optics = SETTINGS.camera.optics
    u = optics.fx * to_label[0, 3] / to_label[2, 3] + optics.cx
    v = optics.fy * to_label[1, 3] / to_label[2, 3] + optics.cy
    cv2.ellipse(image, (int(u), int(v)), (150, 34), 0.0, 0.0, 360.0, (90.0,), -1)
    assert shot.look(image, times=CORNERS_EVERY) is Unseen.TOO_DIRTY
