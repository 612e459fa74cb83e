"""The garage: a floor and a wall that fade out, and the charging station on the wall."""

from __future__ import annotations

import itertools
import math

import numpy as np

from twin.geometry import RobotGeometry
from twin.scene import layers
from twin.scene.glb import Part
from twin.scene.materials import ACCENT, ANTHRACITE, FLOOR, RUBBER, SHELL, WALL
from twin.scene.shapes import Mesh, Points, grid, plate, rod, rounded_rectangle

_FLOOR_RADIUS = 2600.0
_STATION = (230.0, 320.0, 96.0)


def floor(geometry: RobotGeometry) -> list[Part]:
    """A disc about the robot that grows transparent towards its rim."""
    radii = np.linspace(0.001, 1.0, 9)
    angles = np.linspace(0, 2 * math.pi, 37)
    x = radii[:, None] * np.cos(angles) * _FLOOR_RADIUS
    z = radii[:, None] * np.sin(angles) * _FLOOR_RADIUS
    points = np.stack([x, np.zeros_like(x), z], axis=-1)
    alpha = 0.9 * np.broadcast_to((1 - radii**1.5)[:, None], x.shape)
    middle = (geometry.base_width_mm / 2, layers.FLOOR_Y, 350.0)
    return [(grid(points, np.asarray(alpha)).moved(middle), FLOOR)]


def wall(geometry: RobotGeometry) -> list[Part]:
    """The wall behind the robot. It is only seen from the room: from behind it is not there."""
    half, low, high = geometry.base_width_mm / 2 + 900.0, layers.FLOOR_Y, 1250.0
    x = np.linspace(-half, half, 17)
    y = np.linspace(low, high, 11)
    xs, ys = np.meshgrid(x, y)
    points = np.stack([xs, ys, np.zeros_like(xs)], axis=-1)
    sideways = np.clip((half - np.abs(xs)) / 800.0, 0, 1)
    upwards = np.clip((high - ys) / 700.0, 0, 1)
    alpha = 0.85 * _smooth(sideways) * _smooth(upwards)
    skin: Mesh = grid(points, alpha)
    return [(skin.moved((geometry.base_width_mm / 2, 0, layers.WALL_Z)), WALL)]


def wall_base(geometry: RobotGeometry) -> list[Part]:
    """The foot of the wall as if it were cut off, so that it is understood from behind too."""
    half, thickness, height = geometry.base_width_mm / 2 + 900.0, 110.0, 46.0
    x = np.linspace(-half, half, 25)
    profile = np.array([(0, -thickness), (height, -thickness), (height, 0), (0, 0)])[::-1]
    alpha = 0.9 * _smooth(np.clip((half - np.abs(x)) / 700.0, 0, 1))
    strips = []
    for (y0, z0), (y1, z1) in itertools.pairwise(profile):
        ends = [
            np.column_stack([x, np.full(25, y), np.full(25, z)]) for y, z in ((y0, z0), (y1, z1))
        ]
        strips.append(grid(np.stack(ends), np.tile(alpha, (2, 1))))
    at = (geometry.base_width_mm / 2, layers.FLOOR_Y, layers.WALL_Z)
    return [(strip.moved(at), WALL) for strip in strips]


def _smooth(t: Points) -> Points:
    return np.asarray(t * t * (3 - 2 * t))


def station_place_mm(geometry: RobotGeometry) -> Points:
    """Middle of the charging station's back on the wall."""
    x = geometry.base_width_mm + layers.WALLBOX_GAP
    return np.array([x, layers.WALLBOX_Y, layers.WALL_Z])


def station() -> list[Part]:
    """The charging station; origin the middle of its back, z out of the wall."""
    width, height, depth = _STATION
    case = plate(rounded_rectangle(width, height, 44.0), depth, chamfer_mm=14.0)
    face = plate(rounded_rectangle(width - 66, height - 120, 26.0), 4.0, chamfer_mm=1.5)
    light = plate(rounded_rectangle(width - 66, 9.0, 4.0), 3.0, chamfer_mm=1.0)
    gland = rod(17.0, 34.0, chamfer_mm=4.0)
    down = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return [
        (case, SHELL),
        (face.moved((0, 36.0, depth - 1.0)), ANTHRACITE),
        (light.moved((0, -72.0, depth - 0.5)), ACCENT),
        (gland.turned(down).moved((0, -height / 2 + 8.0, depth / 2)), RUBBER),
    ]


def cable_inlet_mm(geometry: RobotGeometry) -> Points:
    """Where the cable leaves the charging station, in the base frame, shape (3,)."""
    _, height, depth = _STATION
    return np.add(station_place_mm(geometry), (0.0, -height / 2 - 22.0, depth / 2))
