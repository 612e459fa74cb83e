from __future__ import annotations

from functools import cache

import cv2
import numpy as np
import pytest

from drivers.camera import pi_camera_v2
from drivers.simulator.car import park
from drivers.simulator.parameters import CarParameters, ContactParameters
from server.config.settings import Settings
from server.localisation.looks import Look, LookPlanner
from server.schema.vehicles import SocketOffset, Vehicle
from tests.support.robot_cell import GEOMETRY
from twin.camera_mount import CameraMount
from twin.kinematics import PlatformPosition, alpha, gamma

SETTINGS = Settings()
OPTICS = pi_camera_v2()
PLUG_LENGTH_MM = 300.0
CARS = 400


@cache
def planner() -> LookPlanner:
    offset = SocketOffset(x_mm=120.0, y_mm=0.0, z_mm=0.0, rotation_x_rad=0.0, rotation_y_rad=0.0)
    vehicle = Vehicle(
        id="demo", name="Demo", label_payload="PLUGPILOT:1:demo", label_size_mm=60.0, socket=offset
    )
    return LookPlanner(
        GEOMETRY,
        CameraMount(),
        OPTICS,
        vehicle,
        insertion_depth_mm=SETTINGS.insertion.depth_mm,
        approach_mm=SETTINGS.insertion.pre_insertion_distance_mm,
    )


def looks_from(x_mm: float, y_mm: float) -> list[Look]:
    return list(planner().looks(x_mm, y_mm, SETTINGS.park.rho3_mm))


def sees(look: Look, T_base_label: np.ndarray, rho3_mm: float) -> bool:
    """By brute force: the rim of label and quiet zone, through the lens, past the plug."""
    half = 30.0 * 33 / 25  # four modules of quiet zone around 25
    corners = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
    rim = np.concatenate([np.linspace(corners[i], corners[(i + 1) % 4], 9) for i in range(4)])
    points = rim @ T_base_label[:3, :3].T + T_base_label[:3, 3]
    camera = np.array([look.x_mm + 120.0, look.y_mm - 15.0, -50.0])
    in_camera = (points - camera) * (-1.0, -1.0, 1.0)  # half a turn about the optical axis
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, OPTICS.matrix, OPTICS.distortion)
    pixels = pixels.reshape(-1, 2)
    if np.any(pixels < 0) or np.any(pixels > (OPTICS.width - 1, OPTICS.height - 1)):
        return False
    dy_mm, z_mm = gamma.tip_offset(GEOMETRY, rho3_mm)
    tip = np.array([look.x_mm, look.y_mm + dy_mm, z_mm])
    axis = np.array(GEOMETRY.insertion_axis)
    along_sight = np.linspace(0.0, 1.0, 300)[:, None, None]
    from_tip = camera + along_sight * (points - camera) - tip
    along = from_tip @ axis
    distance = np.linalg.norm(from_tip - along[..., None] * axis, axis=-1)
    in_plug = distance < GEOMETRY.plug_diameter_mm / 2
    return not np.any(in_plug & (along < 0) & (along > -PLUG_LENGTH_MM))


@pytest.mark.parametrize(
    "start",
    [(SETTINGS.park.x_mm, SETTINGS.park.y_mm), (560.0, 250.0), (740.0, 420.0)],
    ids=["parked", "lower left", "upper right"],
)
def test_every_car_that_can_be_served_is_seen_in_one_of_few_looks(
    start: tuple[float, float],
) -> None:
    looks = looks_from(*start)
    assert (looks[0].x_mm, looks[0].y_mm) == start, "the first look costs no motion"
    assert len(looks) <= 8
    needed = []
    for seed in range(CARS):
        rng = np.random.default_rng(seed)
        label = park(GEOMETRY, CarParameters(), ContactParameters(), rng).T_base_label
        seen_in = [
            number
            for number, look in enumerate(looks, 1)
            if sees(look, label, SETTINGS.park.rho3_mm)
        ]
        assert seen_in, f"the label of car {seed} is in none of {len(looks)} looks"
        needed.append(seen_in[0])
    if start == (SETTINGS.park.x_mm, SETTINGS.park.y_mm):
        assert np.mean(np.array(needed) == 1) > 0.9, "the parking place is chosen for its view"


def test_every_look_is_within_reach_and_adds_something() -> None:
    looks = looks_from(560.0, 250.0)
    for look in looks[1:]:
        assert look.share > 0
        carriages = alpha.inverse(GEOMETRY, PlatformPosition(look.x_mm, look.y_mm))
        for carriage, travel in zip(carriages, GEOMETRY.joint_ranges, strict=False):
            assert travel.excess_mm(carriage) == 0.0
    assert sum(look.share for look in looks) == pytest.approx(1.0)


def test_a_pulled_out_plug_hides_labels_that_a_drawn_back_one_does_not() -> None:
    back = next(planner().looks(616.0, 335.0, GEOMETRY.rho3.min_mm)).share
    out = next(planner().looks(616.0, 335.0, GEOMETRY.rho3.max_mm)).share
    assert out <= back
