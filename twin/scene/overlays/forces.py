"""Forces as arrows: on the plug, in the carriages that hold it, and the pull of the cable."""

from __future__ import annotations

import logging

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.kinematics.errors import KinematicsError
from twin.scene import plug_parts
from twin.scene.frames import Quaternion, turn
from twin.scene.glb import Part
from twin.scene.materials import FORCE, PULLING, Material
from twin.scene.nodes import add_label, add_part, add_pivot, place, set_text, set_visible
from twin.scene.overlays import FORCES, PULL
from twin.scene.shapes import lathe
from twin.scene.state import TwinState
from twin.statics import JointForces, TipForce, actuator_forces

logger = logging.getLogger(__name__)

LEAST_FORCE_N = 3.0
"""Smallest force that gets an arrow."""
ARROW_MM_PER_N = 2.0

_WIDTH = 0.006
_SAME_PULL_N = 0.1
"""A pull that changed less leaves its arrow as it is drawn."""
_LABEL_BEYOND_MM = 14.0
_TO_THE_RIGHT: Quaternion = turn((0.0, 1.0, 0.0), np.pi / 2)


def _unit_arrow(material: Material) -> list[Part]:
    """A metre long and a metre wide, along z: its node's scale is its size."""
    profile = [(0, 0), (600, 0), (600, 700), (1400, 700), (0, 1000)]
    return [(lathe(profile, count=10), material)]


class ForceArrow:
    """An arrow along the z axis of its pivot with its size in words; a negative one points back."""

    def __init__(self, scene: SceneApi, name: str, material: Material, title: str) -> None:
        self.pivot = add_pivot(scene, name, visible=False)
        self.arrow = add_part(scene, f"{name}/arrow", _unit_arrow(material), shadow=False)
        self.label = add_label(scene, f"{name}/size", "")
        self._title = title
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
        set_text(self.label, f"{self._title} {abs(rounded)} N")


class ForceNodes:
    """Arrows on the plug and on both carriages."""

    def __init__(self, scene: SceneApi, geometry: RobotGeometry) -> None:
        self._geometry = geometry
        on_plug, on_left, on_right = FORCES.nodes
        for name in FORCES.nodes:
            add_pivot(scene, name)
        self.insertion = ForceArrow(scene, f"{on_plug}/insertion", FORCE, "plug")
        place(self.insertion.pivot, (0.0, plug_parts.PLUG_RADIUS + 30.0, -20.0))
        add_pivot(scene, PULL.nodes[0], visible=False)
        self.cable = ForceArrow(scene, f"{PULL.nodes[0]}/cable", PULLING, "cable")
        x, y, z = plug_parts.cable_outlet_mm()
        place(self.cable.pivot, (float(x), float(y), float(z)))
        self._shown_pull_n: NDArray[np.float64] | None = None
        self.left = ForceArrow(scene, f"{on_left}/rho1", FORCE, "rho1")
        self.right = ForceArrow(scene, f"{on_right}/rho2", FORCE, "rho2")
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
        forces = carriage_forces(self._geometry, state)
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


def carriage_forces(geometry: RobotGeometry, state: TwinState) -> JointForces:
    """What the actuators carry because the plug pushes; friction and weight are not in it.

    None of it is known without joints, and a robot without a pose carries nothing.
    """
    if state.measured is None or abs(state.force_n) < LEAST_FORCE_N:
        return JointForces(0.0, 0.0, 0.0)
    push = TipForce(*(state.force_n * part for part in geometry.insertion_axis))
    try:
        return actuator_forces(geometry, state.measured, push)
    except KinematicsError:
        return JointForces(0.0, 0.0, 0.0)  # the robot itself is hidden, and says why
