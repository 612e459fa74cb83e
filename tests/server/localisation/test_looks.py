from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import cv2
import numpy as np
import pytest

from drivers.camera import CameraModel, pi_camera_v2
from drivers.simulator.car import park
from drivers.simulator.parameters import CarParameters, ContactParameters
from server.calibration.versions.values import ValuesInForce
from server.config.camera import NO_DOUBT, CameraDoubt
from server.config.settings import Settings
from server.control.built_robot import BuiltRobot
from server.localisation.known_camera import KnownCamera
from server.localisation.looks import Look, LookPlanner
from server.localisation.platform_places import BEYOND_MM, RAIL_END_MM, beyond_regular_box_mm
from server.schema.calibrations import CameraValues, RobotValues
from server.schema.vehicles import SocketOffset, Vehicle
from tests.support.robot_cell import GEOMETRY
from twin.as_built import PlanarAsBuilt
from twin.camera_mount import CameraMount
from twin.kinematics import PlatformPosition, alpha, gamma
from twin.workspace import reachable_region

SETTINGS = Settings()
OPTICS, MOUNT = pi_camera_v2(), CameraMount().T_platform_camera
PARKED = (SETTINGS.park.x_mm, SETTINGS.park.y_mm)
SLIDE_MM = SETTINGS.park.rho3_mm
PLUG_LENGTH_MM = 300.0
CARS = 400

DRAWN = CameraDoubt()
CALIBRATED = (
    ValuesInForce(
        camera=CameraValues(camera=OPTICS),
        robot=RobotValues(
            mechanism=PlanarAsBuilt.as_drawn(GEOMETRY), camera_rotation_rad=(0.0, 0.0, math.pi)
        ),
    )
    .known_camera(SETTINGS.camera)
    .doubt
)


def planner(doubt: CameraDoubt, built: BuiltRobot | None = None) -> LookPlanner:
    offset = SocketOffset(x_mm=120.0, y_mm=0.0, z_mm=0.0, rotation_x_rad=0.0, rotation_y_rad=0.0)
    vehicle = Vehicle(
        id="demo", name="Demo", label_payload="PLUGPILOT:1:demo", label_size_mm=60.0, socket=offset
    )
    camera = KnownCamera(OPTICS, CameraMount(), doubt)
    return LookPlanner(GEOMETRY, built or BuiltRobot(), camera, vehicle, SETTINGS.insertion)


@cache
def looks_from(
    place: tuple[float, float], doubt: CameraDoubt = DRAWN, slide_mm: float = SLIDE_MM
) -> list[Look]:
    return [Look(*place, 0.0), *planner(doubt).further_looks(*place, slide_mm)]


class BuiltCamera(NamedTuple):
    """As it is: on the platform, its lens, and how far that is from where it should be."""

    T_platform_camera: np.ndarray = MOUNT
    optics: CameraModel = OPTICS
    off_mm: np.ndarray = np.zeros(3)


AS_DRAWN = BuiltCamera()


def sees(look: Look, T_base_label: np.ndarray, built: BuiltCamera = AS_DRAWN) -> bool:
    """By brute force: code and what of the white around it is read, the lens, and the plug."""
    half = 30.0 * 29 / 25  # two modules of quiet zone around 25
    corners = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
    rim = np.concatenate([np.linspace(corners[i], corners[(i + 1) % 4], 9) for i in range(4)])
    points = rim @ T_base_label[:3, :3].T + T_base_label[:3, 3]
    T_platform_camera, optics, off_mm = built
    platform = np.array([look.x_mm, look.y_mm, 0.0]) + off_mm
    camera = platform + T_platform_camera[:3, 3]
    in_camera = (points - camera) @ T_platform_camera[:3, :3]
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, optics.matrix, optics.distortion)
    pixels = pixels.reshape(-1, 2)
    if np.any(pixels < 0) or np.any(pixels > (optics.width - 1, optics.height - 1)):
        return False
    tip = platform + np.array([0.0, *gamma.tip_offset(GEOMETRY, SLIDE_MM)])
    axis = np.array(GEOMETRY.insertion_axis)
    along_sight = np.linspace(0.0, 1.0, 300)[:, None, None]
    from_tip = camera + along_sight * (points - camera) - tip
    along = from_tip @ axis
    distance = np.linalg.norm(from_tip - along[..., None] * axis, axis=-1)
    in_plug = distance < GEOMETRY.plug_diameter_mm / 2
    return not np.any(in_plug & (along < 0) & (along > -PLUG_LENGTH_MM))


@pytest.mark.parametrize(
    "start", [PARKED, (560.0, 250.0), (740.0, 420.0)], ids=["parked", "lower left", "upper right"]
)
def test_every_car_that_stands_well_is_seen_in_one_of_few_looks(
    start: tuple[float, float],
) -> None:
    usual = [look for look in looks_from(start) if not look.wide]
    assert len(usual) <= 6
    needed = []
    for seed in range(CARS):
        rng = np.random.default_rng(seed)
        label = park(GEOMETRY, CarParameters(), ContactParameters(), rng).T_base_label
        first = next((number for number, look in enumerate(usual, 1) if sees(look, label)), None)
        assert first is not None, f"the label of car {seed} is in none of {len(usual)} looks"
        needed.append(first)
    if start == PARKED:
        assert np.mean(np.array(needed) == 1) > 0.9, "the parking place is chosen for its view"
        assert np.mean(needed) < 1.15


def signs(rng: np.random.Generator, count: int) -> np.ndarray:
    """Most often at the very limit, shape (count,), from -1 to 1."""
    anywhere = rng.uniform(-1.0, 1.0, count)
    return np.where(rng.random(count) < 0.7, np.sign(anywhere), anywhere)


def served_place(rng: np.random.Generator) -> np.ndarray:
    """Where the platform can plug in, at the limit of what is looked at as often as not."""
    region = reachable_region(GEOMETRY)
    box = GEOMETRY.regular_box
    while True:
        x, y = signs(rng, 2) * (0.5 * np.array([box.width_mm, box.height_mm]) + BEYOND_MM)
        place = np.array([box.center_x_mm + x, box.center_y_mm + y])
        near = beyond_regular_box_mm(GEOMETRY, place[None])[0] <= BEYOND_MM
        if near and region.contains(*place.tolist()):
            return place


def built_camera(doubt: CameraDoubt, rng: np.random.Generator) -> BuiltCamera:
    """Some camera within the doubt."""
    mount = MOUNT.copy()
    mount[:3, :3] @= cv2.Rodrigues(doubt.turn_rad * signs(rng, 3))[0]
    mount[:3, 3] += doubt.mount_mm * signs(rng, 3)
    longer, right_px, down_px = signs(rng, 3) * (doubt.focal_share, *2 * (doubt.centre_px,))
    optics = OPTICS.model_copy(
        update={
            "fx": OPTICS.fx * (1 + longer),
            "fy": OPTICS.fy * (1 + longer),
            "cx": OPTICS.cx + right_px,
            "cy": OPTICS.cy + down_px,
        }
    )
    return BuiltCamera(mount, optics, np.append(doubt.platform_mm * signs(rng, 2), 0.0))


@pytest.mark.parametrize("doubt", [DRAWN, CALIBRATED], ids=["as drawn", "calibrated"])
def test_every_camera_within_its_doubt_sees_every_label_that_can_be_served(
    doubt: CameraDoubt,
) -> None:
    looks = looks_from(PARKED, doubt)
    travel, insertion = GEOMETRY.rho3, SETTINGS.insertion
    middle_mm = 0.5 * (
        travel.min_mm + insertion.pre_insertion_distance_mm + travel.max_mm - insertion.depth_mm
    )
    way_mm = travel.max_mm - insertion.depth_mm - middle_mm
    straight = np.column_stack([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], GEOMETRY.insertion_axis])
    straight[:, 1] = np.cross(straight[:, 2], straight[:, 0])
    lost = []
    for seed in range(CARS):
        rng = np.random.default_rng(seed)
        camera = built_camera(doubt, rng)
        dy_mm, z_mm = gamma.tip_offset(GEOMETRY, middle_mm + way_mm * signs(rng, 1)[0])
        axis = rng.normal(size=3)
        tilt = cv2.Rodrigues(axis / np.linalg.norm(axis) * math.radians(insertion.max_tilt_deg))[0]
        label = np.eye(4)
        label[:3, :3] = straight @ tilt
        place = served_place(rng)
        label[:3, 3] = [place[0], place[1] + dy_mm, z_mm]
        label[:3, 3] -= label[:3, :3] @ (120.0, 0.0, 0.0)
        if not any(sees(look, label, camera) for look in looks):
            lost.append((seed, place.round(1).tolist()))
    assert not lost, f"in none of {len(looks)} looks: {lost}"


def test_looks_are_within_reach_and_each_adds_something() -> None:
    looks = looks_from((560.0, 250.0))[1:]
    for look in looks:
        assert look.share > 0
        carriages = alpha.inverse(GEOMETRY, PlatformPosition(look.x_mm, look.y_mm))
        for carriage, travel in zip(carriages, GEOMETRY.joint_ranges, strict=False):
            assert travel.min_mm + RAIL_END_MM < carriage < travel.max_mm - RAIL_END_MM
    assert [look.wide for look in looks] == sorted(look.wide for look in looks)
    assert sum(look.share for look in looks if not look.wide) < 1.0, "the first look shows some"


def test_the_less_is_in_doubt_the_fewer_looks_are_needed() -> None:
    exact, calibrated, drawn = (
        len(looks_from(PARKED, doubt)) for doubt in (NO_DOUBT, CALIBRATED, DRAWN)
    )
    assert exact <= calibrated < drawn <= 18
    assert CALIBRATED.mount_mm == DRAWN.mount_mm, "no motion tells where the camera sits"


def test_a_built_robot_is_sent_only_where_it_can_stand() -> None:
    mechanism = PlanarAsBuilt.as_drawn(GEOMETRY)
    long_leg = mechanism.model_copy(update={"left_leg_mm": mechanism.left_leg_mm + 30.0})
    built = BuiltRobot.of(GEOMETRY, long_leg)
    assert not all(stands(built, look) for look in looks_from(PARKED)), "the leg changes nothing"
    assert all(
        stands(built, look) for look in planner(DRAWN, built).further_looks(*PARKED, SLIDE_MM)
    )


def stands(built: BuiltRobot, look: Look) -> bool:
    assert built.correction is not None
    rho = alpha.inverse(GEOMETRY, PlatformPosition(look.x_mm, look.y_mm))
    board = built.correction.to_board_many(np.array([*rho, GEOMETRY.rho3.min_mm]))
    ranges = GEOMETRY.joint_ranges[:2]
    return all(
        travel.min_mm <= carriage <= travel.max_mm
        for carriage, travel in zip(board.tolist(), ranges, strict=False)
    )


def test_a_pulled_out_plug_hides_labels_that_a_drawn_back_one_does_not() -> None:
    back, out = (
        sum(not look.wide for look in looks_from((616.0, 335.0), NO_DOUBT, slide_mm))
        for slide_mm in (GEOMETRY.rho3.min_mm, GEOMETRY.rho3.max_mm)
    )
    assert out > back
