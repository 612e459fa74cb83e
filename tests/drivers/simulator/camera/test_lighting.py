"""Lamps: how their light falls off, and where they are seen mirrored."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import CameraModel
from drivers.simulator.camera.car_plane import car_plane
from drivers.simulator.camera.coarse_grid import CoarseGrid, Region
from drivers.simulator.camera.conditions import FLAWLESS, LampConditions
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.lighting import Lighting, reflections
from drivers.simulator.camera.renderer import Renderer
from drivers.simulator.camera.row_motion import RowMotion
from tests.drivers.simulator.camera.scenes import everything, pose, view

OPTICS = CameraModel(width=640, height=480, fx=530.0, fy=530.0, cx=319.5, cy=239.5)
PLAIN = ImagingParameters(vignetting=0.0, illumination_gradient=0.0)
GRID = CoarseGrid(OPTICS, 8)
STILL = RowMotion(view(pose(0.0, 0.0, 300.0)), 0.0, OPTICS.height)


def own_light(distance_mm: float, **lamps: float) -> np.ndarray:
    """The robot's own light alone, beside the lens, at all pixels."""
    numbers = LampConditions(own=1.0, own_mm=(0.0, 0.0, 0.0), ceiling=0.0, **lamps)
    socket = pose(0.0, 0.0, distance_mm)
    car = car_plane(GRID, socket, STILL)
    light = Lighting(PLAIN, numbers, OPTICS, GRID).at(car, socket, 0.0)
    return GRID.enlarged(light.on_car)


def test_its_own_light_falls_off_with_the_square_of_the_distance() -> None:
    assert own_light(300.0)[240, 320] == pytest.approx(1.0, abs=0.01)
    assert own_light(600.0)[240, 320] == pytest.approx(0.25, abs=0.003)


def test_its_own_light_is_that_of_its_beam_off_the_axis() -> None:
    """By hand at 30 degrees: distance, incidence and half the light at that angle."""
    light = own_light(300.0, own_half_angle_rad=np.radians(30))
    column = round(319.5 + 530.0 * np.tan(np.radians(30)))
    expected = np.cos(np.radians(30)) ** 2 * np.cos(np.radians(30)) * 0.5
    assert light[240, column] == pytest.approx(expected, rel=0.01)


def brightest_mm(lamp_mm: tuple[float, float, float], distance_mm: float, shift: float) -> float:
    """Where along the car's x a lamp is mirrored in a flat surface."""
    numbers = LampConditions(ceiling=1.0, ceiling_mm=lamp_mm)
    socket = pose(shift, 0.0, distance_mm)
    car = car_plane(GRID, socket, STILL)
    light = Lighting(PLAIN, numbers, OPTICS, GRID).at(car, socket, 1.0)
    shine = reflections(light, car.places_mm, car.mirrored(0.0, 0.0), 0.02)
    place = np.unravel_index(int(np.argmax(shine)), shine.shape)
    return float(car.places_mm[place][0])


@pytest.mark.parametrize("shift", [-60.0, 0.0, 60.0])
def test_a_lamp_is_mirrored_where_the_law_of_reflection_says(shift: float) -> None:
    """The lamp's mirror image is as far behind the surface as the lamp is in front of it."""
    seen = brightest_mm((200.0, 0.0, -900.0), 300.0, shift)
    camera_x = -shift
    expected = camera_x + (200.0 - camera_x) * 300.0 / (300.0 + 900.0)
    assert seen == pytest.approx(expected, abs=5.0)  # the nodes are 4.5 mm apart


def test_without_any_light_there_is_none() -> None:
    assert float(own_light(300.0).min()) >= 0.0
    night = FLAWLESS.model_copy(update={"lamps": LampConditions()})
    renderer = Renderer(OPTICS, ImagingParameters(), 1, night)
    image = renderer.picture(view(pose(0.0, 0.0, 300.0)), 0, light=0.0)
    assert np.percentile(image, 99) < 70  # read-out noise at a gain of 3


def test_enlarging_a_part_is_a_part_of_enlarging_all() -> None:
    rng = np.random.default_rng(2)
    field = rng.random(GRID.rays.shape[:2], dtype=np.float32)
    part = Region(133, 77, 410, 300)
    whole = GRID.enlarged(field)
    assert whole.shape == (480, 640)
    enlarged = GRID.enlarged_part(field[GRID.around(part)], part)
    assert np.array_equal(enlarged, whole[77:300, 133:410])


def test_enlarging_keeps_a_linear_field_exact_up_to_the_borders() -> None:
    slope = (GRID.u_px * 0.01 + GRID.v_px[:, None] * 0.02).astype(np.float32)
    u, v = np.arange(640), np.arange(480)[:, None]
    assert np.abs(GRID.enlarged(slope) - (u * 0.01 + v * 0.02)).max() < 1e-4


def test_all_effects_together_follow_from_seed_and_number() -> None:
    imaging, conditions = everything()
    scene = view(pose(5.0, -9.0, 280.0, (0.02, 0.03, 0.0)), velocity_mm_s=(50.0, 5.0, 0.0))
    one, other = (Renderer(OPTICS, imaging, 8, conditions) for _ in range(2))
    other.picture(scene, 3)  # what was drawn before does not matter
    assert np.array_equal(one.picture(scene, 7), other.picture(scene, 7))
    assert not np.array_equal(one.picture(scene, 7), one.picture(scene, 8))
    assert not np.array_equal(
        one.picture(scene, 7), Renderer(OPTICS, imaging, 9, conditions).picture(scene, 7)
    )
