from __future__ import annotations

import numpy as np
import pytest

from server.guidance.model import Direction
from server.guidance.track import CarTrack
from server.guidance.vanishing import Vanishing
from server.jobs.approach import parking_joints
from server.localisation.frames import base_from_camera
from tests.server.guidance.cars import SETTINGS, sighting

JOINTS = parking_joints(SETTINGS.geometry, SETTINGS.park)
T_BASE_CAMERA = base_from_camera(SETTINGS.geometry, SETTINGS.camera.mount, JOINTS)
CAMERA_MM = T_BASE_CAMERA[:3, 3]
TO_LABEL_MM = np.array([120.0, 0.0, 0.0])


def direction(
    label_mm: tuple[float, float, float],
    velocity_mm_s: tuple[float, float, float] = (0.0, 0.0, 0.0),
    *,
    faces_robot: bool = True,
) -> Direction | None:
    """For a label at a place relative to the camera that has come there at a speed."""
    velocity = np.array(velocity_mm_s)
    end = CAMERA_MM + np.array(label_mm) - TO_LABEL_MM
    faces = {"driver_faces": "robot" if faces_robot else "away"}
    settings = SETTINGS.guidance.model_copy(update=faces)
    track = CarTrack(sighting(0.0, end - velocity * 1.0), settings)
    for t_s in np.linspace(0.1, 1.0, 10).tolist():
        track.take(sighting(t_s, end - velocity * (1.0 - t_s)))
    vanishing = Vanishing(SETTINGS.camera.optics, SETTINGS.geometry)
    return vanishing.direction(track, 1.0, T_BASE_CAMERA, JOINTS)


def test_a_label_in_the_middle_has_no_excuse() -> None:
    assert direction((0.0, 0.0, 300.0)) is None


@pytest.mark.parametrize(
    ("label_mm", "expected"),
    [
        ((190.0, 0.0, 300.0), Direction.RIGHT),
        ((-320.0, 0.0, 500.0), Direction.LEFT),
        ((0.0, 125.0, 300.0), Direction.UP),
        ((0.0, -125.0, 300.0), Direction.DOWN),
    ],
)
def test_out_of_the_picture(label_mm: tuple[float, float, float], expected: Direction) -> None:
    assert direction(label_mm) is expected


def test_it_is_about_to_leave() -> None:
    assert direction((130.0, 0.0, 320.0)) is None
    assert direction((130.0, 0.0, 320.0), (60.0, 0.0, -40.0)) is Direction.RIGHT


def test_behind_the_robot_s_own_plug() -> None:
    assert direction((-200.0, 0.0, 450.0)) is Direction.LEFT
    assert direction((-60.0, 0.0, 450.0)) is None


def test_from_the_seat_of_who_backs_in() -> None:
    assert direction((190.0, 0.0, 300.0), faces_robot=False) is Direction.LEFT
