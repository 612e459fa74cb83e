"""Red rings around the parts where robot and model have parted, each with a word."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viser import FrameHandle, SceneApi

from twin.scene.frames import UPRIGHT, Quaternion, Vector, turn
from twin.scene.materials import Material
from twin.scene.nodes import ORIGIN, add_label, add_part, add_pivot, place, set_visible
from twin.scene.shapes import Mesh, lathe
from twin.scene.state import TwinState

ALARM = Material("alarm", (255, 38, 62), roughness=0.6, glow=0.6)

_PULSES_PER_S = 0.8
_PULSE = 0.10
_TUBE_MM, _RADIUS_MM = 6.0, 60.0
_AROUND_Y = turn((1.0, 0.0, 0.0), math.pi / 2)


@dataclass(frozen=True, slots=True)
class _Ring:
    """A ring that hangs on a part.

    Attributes:
        name: Of its node.
        word: Beside it.
        quantities: Of `twin.divergence.Quantity` for which it is shown.
        radius_mm: Of the ring.
        at_mm: Its middle in the part's frame.
        wxyz: Its turn; without one its axis is the part's z.
        word_at_mm: From its middle; apart from those of rings that may be shown with it.
    """

    name: str
    word: str
    quantities: frozenset[str]
    radius_mm: float
    at_mm: Vector
    word_at_mm: Vector
    wxyz: Quaternion = UPRIGHT


def _around_carriage(name: str, quantity: str) -> _Ring:
    return _Ring(
        name,
        "not in place",
        frozenset({quantity}),
        radius_mm=78.0,
        at_mm=(0.0, 0.0, -102.0),
        word_at_mm=(0.0, -70.0, 0.0),
        wxyz=_AROUND_Y,
    )


_RINGS = (
    _around_carriage("/robot/left_carriage/parted", "rho1"),
    _around_carriage("/robot/right_carriage/parted", "rho2"),
    _Ring(
        "/robot/platform/plug/parted_place",
        "not in place",
        frozenset({"rho3", "set_point"}),
        radius_mm=56.0,
        at_mm=(0.0, 0.0, -80.0),
        word_at_mm=(0.0, -105.0, 0.0),
    ),
    _Ring(
        "/robot/platform/plug/parted_force",
        "unusual force",
        frozenset({"force"}),
        radius_mm=46.0,
        at_mm=(0.0, 0.0, -14.0),
        word_at_mm=(0.0, 105.0, 0.0),
    ),
    _Ring(
        "/car/parted",
        "has moved",
        frozenset({"socket"}),
        radius_mm=68.0,
        at_mm=(0.0, 0.0, -6.0),
        word_at_mm=(0.0, -140.0, 0.0),
    ),
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
            place(mesh, ORIGIN, ring.wxyz)
            add_label(scene, f"{ring.name}/word", ring.word, at_mm=ring.word_at_mm)
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
    steps = 8
    tube = [2 * math.pi * i / steps for i in range(steps + 1)]
    return lathe(
        [(_RADIUS_MM + _TUBE_MM * math.cos(a), _TUBE_MM * math.sin(a)) for a in tube], count=32
    )
