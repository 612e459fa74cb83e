"""Forces as arrows: on the plug, in the carriages that hold it, and the pull of the cable.

Their colour says how much of what is allowed they take: red is the limit.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.kinematics.errors import KinematicsError
from twin.scene import plug_parts
from twin.scene.frames import Quaternion, turn
from twin.scene.materials import PULLING, Rgb
from twin.scene.nodes import add_label, add_pivot, add_signal, place, set_text, set_visible
from twin.scene.overlays import FORCES, PULL
from twin.scene.overlays.colors import GOOD_TO_BAD, ColorScale
from twin.scene.shapes import Mesh, lathe
from twin.scene.state import TwinState
from twin.statics import ActuatorLimits, JointForces, Loads, alpha_actuator_forces
from twin.statics.loads import GRAVITY_M_S2

LEAST_FORCE_N = 3.0
"""Smallest force that gets an arrow."""
ARROW_MM_PER_N = 2.0

_WIDTH = 0.006
_SAME_PULL_N = 0.1
"""A pull that changed less leaves its arrow as it is drawn."""
_LABEL_BEYOND_MM = 14.0
_UTILISATION = ColorScale(0.0, 1.0, GOOD_TO_BAD)
_COLOR_STEPS = 20
_TO_THE_RIGHT: Quaternion = turn((0.0, 1.0, 0.0), np.pi / 2)


def _unit_arrow() -> Mesh:
    """A metre long and a metre wide, along z: its node's scale is its size."""
    return lathe([(0, 0), (600, 0), (600, 700), (1400, 700), (0, 1000)], count=6)


def utilisation_color(share: float) -> Rgb:
    """Colour of a force that takes a share of what is allowed, in even steps."""
    r, g, b = _UTILISATION.rgb(round(share * _COLOR_STEPS) / _COLOR_STEPS).tolist()
    return (r, g, b)


class ForceArrow:
    """An arrow along the z axis of its pivot with its size in words; a negative one points back.

    Args:
        scene: Scene to add to.
        name: Of the pivot.
        title: Before the size.
        limit_n: What is allowed; the arrow is coloured by the share of it, and names it. None: it
            has a colour of its own.
    """

    def __init__(self, scene: SceneApi, name: str, title: str, limit_n: float | None) -> None:
        self.pivot = add_pivot(scene, name, visible=False)
        self._color = PULLING if limit_n is None else utilisation_color(0.0)
        self.arrow = add_signal(
            scene, f"{name}/arrow", _unit_arrow(), self._color, scale=(_WIDTH, _WIDTH, _WIDTH)
        )
        self.label = add_label(scene, f"{name}/size", "")
        self._title = title
        self._limit_n = limit_n
        self._shown_n: int | None = None

    def show(self, force_n: float) -> None:
        """Shows a force in whole newtons, or hides one that is too small to matter."""
        visible = abs(force_n) >= LEAST_FORCE_N
        set_visible(self.pivot, visible=visible)
        rounded = round(force_n)
        if not visible or rounded == self._shown_n:
            return
        self._shown_n = rounded
        length = rounded * ARROW_MM_PER_N
        self.arrow.scale = (_WIDTH, _WIDTH, length / 1000)
        beyond = length + np.copysign(_LABEL_BEYOND_MM, length)
        place(self.label, (0.0, 0.0, float(beyond)))
        limit_n = self._limit_n
        of_limit = "" if limit_n is None else f" of {limit_n:.0f}"
        set_text(self.label, f"{self._title} {abs(rounded)}{of_limit} N")
        if limit_n is not None:
            color = utilisation_color(abs(rounded) / limit_n)
            if color != self._color:
                self.arrow.color = self._color = color


class ForceNodes:
    """Arrows on the plug and on both carriages.

    Args:
        scene: Scene to add to.
        geometry: The robot.
        loads: What it carries, and the largest forces at the plug.
        limits: What its actuators can hold.
    """

    def __init__(
        self, scene: SceneApi, geometry: RobotGeometry, loads: Loads, limits: ActuatorLimits
    ) -> None:
        self._geometry = geometry
        self._loads = loads
        on_plug, on_left, on_right = FORCES.nodes
        for name in FORCES.nodes:
            add_pivot(scene, name)
        self.insertion = ForceArrow(scene, f"{on_plug}/insertion", "plug", loads.insertion_force_n)
        place(self.insertion.pivot, (0.0, plug_parts.PLUG_RADIUS + 30.0, -20.0))
        add_pivot(scene, PULL.nodes[0], visible=False)
        self.cable = ForceArrow(scene, f"{PULL.nodes[0]}/cable", "cable", None)
        x, y, z = plug_parts.cable_outlet_mm()
        place(self.cable.pivot, (float(x), float(y), float(z)))
        self._shown_pull_n: NDArray[np.float64] | None = None
        self.left = ForceArrow(scene, f"{on_left}/rho1", "rho1", limits.rho1_n)
        self.right = ForceArrow(scene, f"{on_right}/rho2", "rho2", limits.rho2_n)
        above = (0.0, 55.0, 0.0)
        place(self.left.pivot, above, _TO_THE_RIGHT)
        place(self.right.pivot, above, _TO_THE_RIGHT)

    def show(self, state: TwinState, cable_pull_n: NDArray[np.float64] | None) -> None:
        """Shows the forces of one instant.

        Args:
            state: The instant.
            cable_pull_n: The cable's pull on the plug in the base frame, shape (3,).
        """
        # Pushed back, the plug feels a force against its axis.
        self.insertion.show(-state.force_n)
        forces = carried_forces(self._geometry, self._loads, state)
        self.left.show(forces.rho1_n)
        self.right.show(-forces.rho2_n)  # rho2 grows to the left
        self._show_pull(cable_pull_n)

    def _show_pull(self, pull_n: NDArray[np.float64] | None) -> None:
        if pull_n is None or np.linalg.norm(pull_n) < LEAST_FORCE_N:
            self.cable.show(0.0)
            self._shown_pull_n = None
            return
        before = self._shown_pull_n
        if before is not None and np.abs(pull_n - before).max() < _SAME_PULL_N:
            return
        self._shown_pull_n = pull_n
        size = float(np.linalg.norm(pull_n))
        self.cable.show(size)
        self.cable.pivot.wxyz = self._towards(pull_n / size)

    def _towards(self, direction: NDArray[np.float64]) -> Quaternion:
        """Turn of an arrow in the plug's frame to a direction in the base frame."""
        _, s, c = self._geometry.insertion_axis
        x, y, z = direction
        local = np.array([x, c * y - s * z, s * y + c * z])
        axis = np.cross((0.0, 0.0, 1.0), local)
        length = float(np.linalg.norm(axis))
        angle = float(np.arctan2(length, local[2]))
        if length < 1e-6:
            return turn((1.0, 0.0, 0.0), angle)
        ux, uy, uz = axis / length
        return turn((float(ux), float(uy), float(uz)), angle)


def carried_forces(geometry: RobotGeometry, loads: Loads, state: TwinState) -> JointForces:
    """What the actuators hold: weight, and the reaction to the measured force; without friction.

    None of it is known without joints, and a robot without a pose carries nothing.
    """
    if state.measured is None:
        return JointForces(0.0, 0.0, 0.0)
    rho1_mm, rho2_mm, _ = state.measured
    slope = math.sin(geometry.theta_rad)
    push_n = GRAVITY_M_S2 * loads.on_platform_kg + state.force_n * slope
    try:
        v = alpha.forward(geometry, rho1_mm, rho2_mm)
        legs = alpha.leg_vectors(geometry, v, rho1_mm, rho2_mm)
        carriages = alpha_actuator_forces(legs, 0.0, push_n)
    except KinematicsError:
        return JointForces(0.0, 0.0, 0.0)  # the robot itself is hidden, and says why
    return JointForces(*carriages, state.force_n + GRAVITY_M_S2 * loads.on_slide_kg * slope)
