"""Red rings around the parts where robot and model have parted, each with a word."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viser import FrameHandle, SceneApi

from twin.scene.frames import Vector
from twin.scene.materials import Material
from twin.scene.nodes import add_label, add_part, add_pivot, place, set_visible
from twin.scene.shapes import Mesh, lathe
from twin.scene.state import TwinState

ALARM = Material("alarm", (255, 38, 62), roughness=0.6, glow=0.6)

_PULSES_PER_S = 0.8
_PULSE = 0.10
_TUBE_MM, _RADIUS_MM = 4.0, 60.0
"""Of the one ring that is sent; its nodes scale it, so that a phone downloads it once."""


@dataclass(frozen=True, slots=True)
class _Ring:
    """A ring that hangs on a part.

    Attributes:
        name: Of its node.
        word: Beside it.
        quantities: Of `twin.divergence.Quantity` for which it is shown.
        radius_mm: Of the ring.
        at_mm: Its middle in the part's frame.
    """

    name: str
    word: str
    quantities: frozenset[str]
    radius_mm: float
    at_mm: Vector


_RINGS = (
    _Ring(
        "/robot/left_carriage/parted", "not in place", frozenset({"rho1"}), 62.0, (0.0, 0.0, -80.0)
    ),
    _Ring(
        "/robot/right_carriage/parted", "not in place", frozenset({"rho2"}), 62.0, (0.0, 0.0, -80.0)
    ),
    _Ring(
        "/robot/platform/plug/parted_place",
        "not in place",
        frozenset({"rho3", "set_point"}),
        58.0,
        (0.0, 0.0, -70.0),
    ),
    _Ring(
        "/robot/platform/plug/parted_force",
        "unusual force",
        frozenset({"force"}),
        48.0,
        (0.0, 0.0, -12.0),
    ),
    _Ring("/car/parted", "has moved", frozenset({"socket"}), 66.0, (0.0, 0.0, -6.0)),
)


class DivergenceMarks:
    """The rings of one scene; the parts that they hang on exist already."""

    def __init__(self, scene: SceneApi) -> None:
        self.rings: dict[str, FrameHandle] = {}
        self._pulsing = []
        for ring in _RINGS:
            pivot = add_pivot(scene, ring.name, visible=False)
            place(pivot, ring.at_mm)
            mesh = add_part(scene, f"{ring.name}/ring", [(_torus(), ALARM)], shadow=False)
            mesh.scale = ring.radius_mm / _RADIUS_MM
            label = add_label(scene, f"{ring.name}/word", ring.word)
            place(label, (0.0, ring.radius_mm + 12.0, 0.0))
            self.rings[ring.name] = pivot
            self._pulsing.append((ring, pivot, mesh))

    def show(self, state: TwinState) -> None:
        """Shows the rings of all quantities that have parted."""
        parted = set(state.parted)
        for ring, pivot, _ in self._pulsing:
            set_visible(pivot, visible=not parted.isdisjoint(ring.quantities))

    def animate(self, time_s: float) -> None:
        """Lets the visible rings pulse; sends nothing while there is none."""
        scale = 1 + _PULSE * math.sin(2 * math.pi * _PULSES_PER_S * time_s)
        for ring, pivot, mesh in self._pulsing:
            if pivot.visible:
                mesh.scale = round(scale * ring.radius_mm / _RADIUS_MM, 2)


def _torus() -> Mesh:
    steps = 6
    tube = [2 * math.pi * i / steps for i in range(steps + 1)]
    return lathe(
        [(_RADIUS_MM + _TUBE_MM * math.cos(a), _TUBE_MM * math.sin(a)) for a in tube], count=32
    )
