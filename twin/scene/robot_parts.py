"""Meshes of the robot's moving parts, each in its own frame with the pivot as origin."""

from __future__ import annotations

import math

import numpy as np

from twin.geometry import RobotGeometry
from twin.scene import layers as z
from twin.scene.glb import Part
from twin.scene.materials import ACCENT, ALUMINIUM, ANTHRACITE, RUBBER, SHELL, STEEL
from twin.scene.shapes import Mesh, around, block, circle, plate, rod, rounded_rectangle

JOINT_RADIUS = 17.0


def _between(mesh: Mesh, x_mm: float, y_mm: float, back_z: float) -> Mesh:
    return mesh.moved((x_mm, y_mm, back_z))


def _pin(x_mm: float, y_mm: float, back_z: float, front_z: float) -> list[Part]:
    """A joint: a steel axle with a coloured cap in front."""
    return [
        (_between(rod(8.0, front_z - back_z), x_mm, y_mm, back_z), STEEL),
        (_between(rod(11.5, 5.0, chamfer_mm=1.5), x_mm, y_mm, front_z), ACCENT),
    ]


def rails(geometry: RobotGeometry) -> list[Part]:
    """Both rails with their belts, pulleys and motors, in the base frame.

    The upper rail's belt drives the left carriage, the lower rail's belt the right one.
    """
    start = -z.RAIL_OVERHANG
    length = geometry.base_width_mm + 2 * z.RAIL_OVERHANG
    middle = start + length / 2
    ends_x = (start + 26.0, start + length - 26.0)
    depth = z.RAIL_FRONT_Z - z.RAIL_BACK_Z
    parts: list[Part] = []
    for y_mm, motor_x in ((geometry.e1y_mm, start), (geometry.e_py_mm, start + length)):
        body = block((length, 34.0, depth), radius_mm=5.0)
        front = z.RAIL_FRONT_Z
        parts.append((body.moved((middle, y_mm, (z.RAIL_BACK_Z + front) / 2)), ALUMINIUM))
        groove = block((length - 40.0, 9.0, 1.2), radius_mm=1.0)
        parts.append((groove.moved((middle, y_mm, front + 0.4)), ANTHRACITE))
        for side in (-23.0, 23.0):
            belt = block((length - 60.0, 2.4, 9.0), radius_mm=1.0)
            parts.append((belt.moved((middle, y_mm + side, front + 1.0)), RUBBER))
        pulley = rod(22.0, 12.0)
        parts += [(_between(pulley, x_mm, y_mm, front - 4.0), STEEL) for x_mm in ends_x]
        motor = block((44.0, 44.0, 52.0), radius_mm=6.0)
        inwards = math.copysign(26.0, middle - motor_x)
        parts.append((motor.moved((motor_x + inwards, y_mm, front + 34.0)), ANTHRACITE))
    low, high = sorted((geometry.e1y_mm, geometry.e_py_mm))
    ends = plate(rounded_rectangle(52.0, high - low + 96.0, 10.0), depth + 6.0, chamfer_mm=3.0)
    at_y = (low + high) / 2
    parts += [(ends.moved((x_mm, at_y, z.RAIL_BACK_Z - 8.0)), SHELL) for x_mm in ends_x]
    bracket = plate(rounded_rectangle(70.0, high - low + 70.0, 12.0), 10.0, chamfer_mm=2.0)
    for part in (0.22, 0.5, 0.78):
        at = (start + part * length, at_y, z.RAIL_BACK_Z - 9.0)
        parts.append((bracket.moved(at), ANTHRACITE))
    return parts


def _carriage(pivots: list[tuple[float, float]], rail_offsets: tuple[float, float]) -> list[Part]:
    """A plate over its pivots and both rails, with a runner on each rail."""
    thickness = z.CARRIAGE_FRONT_Z - z.CARRIAGE_BACK_Z
    middle = sum(x for x, _ in pivots) / len(pivots)
    discs = [(x, y, 30.0) for x, y in pivots]
    discs += [(middle + side, y, 24.0) for y in rail_offsets for side in (-34.0, 34.0)]
    parts: list[Part] = [
        (_between(plate(around(discs), thickness, chamfer_mm=3.0), 0, 0, z.CARRIAGE_BACK_Z), SHELL)
    ]
    runner = block((92.0, 40.0, 22.0), radius_mm=5.0)
    behind = z.CARRIAGE_BACK_Z - 8.0
    parts += [(runner.moved((middle, y_mm, behind)), ANTHRACITE) for y_mm in rail_offsets]
    for x_mm, y_mm in pivots:
        parts += _pin(x_mm, y_mm, z.CARRIAGE_FRONT_Z, z.BAR_FRONT_Z + 3.0)
    return parts


def left_carriage(geometry: RobotGeometry) -> list[Part]:
    """Carriage of the left leg; origin A, second pivot D = A + (L3/2, e_py)."""
    d = (geometry.platform_width_mm / 2, geometry.e_py_mm)
    return _carriage([(0.0, 0.0), d], (0.0, geometry.e_py_mm - geometry.e1y_mm))


def right_carriage(geometry: RobotGeometry) -> list[Part]:
    """Carriage of the right leg; origin E."""
    upper, lower = geometry.e1y_mm - geometry.e2y_mm, geometry.e_py_mm - geometry.e2y_mm
    return _carriage([(0.0, 0.0)], (upper, lower))


def bar(geometry: RobotGeometry) -> list[Part]:
    """One bar of length L along its x axis, from its pivot."""
    length = geometry.leg_length_mm
    thickness = z.BAR_FRONT_Z - z.BAR_BACK_Z
    outline = around([(0.0, 0.0, JOINT_RADIUS), (length, 0.0, JOINT_RADIUS)])
    inlay = rounded_rectangle(length - 3 * JOINT_RADIUS, 13.0, 6.0) + np.array([length / 2, 0.0])
    hub = rod(JOINT_RADIUS + 3.0, thickness + 2.0, chamfer_mm=2.0)
    return [
        (_between(plate(outline, thickness, chamfer_mm=3.0), 0, 0, z.BAR_BACK_Z), ALUMINIUM),
        (
            _between(plate(inlay, thickness + 1.2, chamfer_mm=0.5), 0, 0, z.BAR_BACK_Z - 0.6),
            ANTHRACITE,
        ),
        (_between(hub, 0, 0, z.BAR_BACK_Z - 1.0), ANTHRACITE),
        (_between(hub, length, 0, z.BAR_BACK_Z - 1.0), ANTHRACITE),
    ]


def platform(geometry: RobotGeometry) -> list[Part]:
    """The platform with its joints B, C and F; origin V."""
    half = geometry.platform_width_mm / 2
    joints = [(-half, 0.0), (half, 0.0), (0.0, geometry.e_py_mm)]
    thickness = z.PLATFORM_FRONT_Z - z.PLATFORM_BACK_Z
    body = plate(around([(x, y, 27.0) for x, y in joints]), thickness, chamfer_mm=3.5)
    boss = rod(40.0, 5.0, chamfer_mm=2.0)
    parts: list[Part] = [
        (_between(body, 0, 0, z.PLATFORM_BACK_Z), SHELL),
        (_between(boss, 0, geometry.e_py_mm / 4, z.PLATFORM_FRONT_Z - 1.0), ANTHRACITE),
    ]
    for x_mm, y_mm in joints:
        parts += _pin(x_mm, y_mm, z.BAR_BACK_Z, z.PLATFORM_FRONT_Z)
    return parts


def camera_body(x_mm: float, y_mm: float, z_mm: float) -> list[Part]:
    """The camera and its bracket in the platform's frame; the lens looks along +z."""
    bracket = around([(x_mm * 0.45, y_mm * 0.45, 14.0), (x_mm, y_mm, 14.0)])
    ring = circle(8.5, 32)
    return [
        (_between(plate(bracket, 7.0), 0, 0, z_mm - 27.0), ANTHRACITE),
        (block((38.0, 34.0, 18.0), radius_mm=6.0).moved((x_mm, y_mm, z_mm - 12.0)), SHELL),
        (_between(plate(ring, 10.0, chamfer_mm=1.5), x_mm, y_mm, z_mm - 6.0), RUBBER),
    ]
