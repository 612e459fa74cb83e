"""The car in the picture: body, inlet, wheels and label."""

from __future__ import annotations

import math

from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.scene import car, layers, plug_parts, poses
from twin.scene.frames import turn
from twin.scene.materials import CHARGING, IDLE, PLUGGED, Rgb
from twin.scene.nodes import add_part, add_pivot, add_signal, place, place_transform, set_visible
from twin.scene.shapes import lathe
from twin.scene.state import Pose, TwinState


class CarNodes:
    """The car hangs on its socket; its wheels stay on the floor whatever was measured.

    Without a measured socket it is a pale shape at the nominal place.
    """

    def __init__(self, scene: SceneApi, geometry: RobotGeometry) -> None:
        self._nominal = poses.nominal_socket(geometry)
        self._shown: tuple[Pose | None, Pose | None] | None = None
        self._ring_color: Rgb = IDLE
        theta = geometry.theta_rad
        self.car = add_pivot(scene, "/car")
        self.body = add_part(scene, "/car/body", car.body(theta))
        add_part(scene, "/car/inlet", car.inlet())
        self.faded = add_part(scene, "/car/faded", car.silhouette(theta), shadow=False)
        r = plug_parts.CAVITY_RADIUS + 13.0
        ring = lathe([(r + 1, -2), (r + 5, -5), (r + 9, -2), (r + 9, 3)], count=24)
        self.ring = add_signal(scene, "/car/ring", ring, IDLE)
        self.wheels = add_pivot(scene, "/wheels")
        up, back = car.WHEEL_RADIUS, car.WHEEL_Z
        half_turn = turn((0.0, 1.0, 0.0), math.pi)
        add_part(scene, "/wheels/left", car.wheel(), at_mm=(car.WHEEL_X, up, back))
        right = (-car.WHEEL_X, up, back)
        add_part(scene, "/wheels/right", car.wheel(), at_mm=right, wxyz=half_turn)
        self.label = add_part(scene, "/label", car.label())

    def show(self, state: TwinState) -> None:
        """Moves the car and its label to where they were measured; lights the inlet's ring."""
        color = _ring_color(state)
        if color != self._ring_color:
            self.ring.color = self._ring_color = color
        measured = (state.T_base_socket, state.T_base_label)
        if self._shown is not None and all(
            new is old for new, old in zip(measured, self._shown, strict=True)
        ):
            return
        self._shown = measured
        known = state.T_base_socket is not None
        T_socket = (
            self._nominal if state.T_base_socket is None else poses.upright(state.T_base_socket)
        )
        set_visible(self.body, visible=known)
        set_visible(self.wheels, visible=known)
        set_visible(self.faded, visible=not known)
        place_transform(self.car, T_socket)
        x, _, z = (float(value) for value in T_socket[:3, 3])
        heading_rad = math.atan2(float(T_socket[0, 2]), float(T_socket[2, 2]))
        place(self.wheels, (x, layers.FLOOR_Y, z), turn((0.0, 1.0, 0.0), heading_rad))
        T_label = state.T_base_label
        place_transform(self.label, poses.nominal_label(T_socket) if T_label is None else T_label)


def _ring_color(state: TwinState) -> Rgb:
    if state.charging:
        return CHARGING
    return PLUGGED if state.plug == "inserted" else IDLE
