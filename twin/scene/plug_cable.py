"""The charging cable between the station and the plug, one instanced mesh."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.scene import cable
from twin.scene.frames import METRES_PER_MM
from twin.scene.materials import CABLE, CHARGING
from twin.scene.plug_parts import CABLE_RADIUS
from twin.scene.shapes import lathe

_MOVED_MM = 0.2
"""A plug that moved less leaves the cable as it is drawn."""
_PERIOD_S = 0.06
"""Between two drawings: the cable is most of what is sent, and follows every other step."""
_PULSE_SEGMENTS = 12
"""Distance of two light pulses that run along the cable while it charges."""


def _link(length_mm: float) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """One link of the cable with round ends, so that bends show no gaps [m]."""
    half = length_mm / 2
    r = CABLE_RADIUS
    profile = [(0.0, -half - r), (0.7 * r, -half - 0.7 * r), (r, -half)]
    profile += [(radius, -z) for radius, z in reversed(profile)]
    mesh = lathe(profile, count=10)
    return (mesh.vertices_mm * METRES_PER_MM).astype(np.float32), mesh.faces


class PlugCable:
    """The cable's node; its links are placed along a catenary once the plug has moved.

    Attributes:
        node: The links.
        pull_n: The cable's pull on the plug where it was last hung to, in the base frame.
    """

    def __init__(self, scene: SceneApi, start_mm: NDArray[np.float64], spec: cable.Cable) -> None:
        self._start_mm = start_mm
        self._spec = spec
        self.pull_n: NDArray[np.float64] | None = None
        self._end_mm: NDArray[np.float64] | None = None
        self._drawn_end_mm: NDArray[np.float64] | None = None
        self._drawn_at_s = -math.inf
        self._pulse: int | None = None
        vertices, faces = _link(spec.length_mm / cable.SEGMENTS)
        self.node = scene.add_batched_meshes_simple(
            "/cable",
            vertices=vertices,
            faces=faces,
            batched_wxyzs=np.tile([1.0, 0.0, 0.0, 0.0], (cable.SEGMENTS, 1)),
            batched_positions=np.zeros((cable.SEGMENTS, 3)),
            batched_colors=np.tile(np.array(CABLE, dtype=np.uint8), (cable.SEGMENTS, 1)),
            lod="off",
            visible=False,
        )

    def hang_to(self, end_mm: NDArray[np.float64]) -> None:
        """Says where the cable ends, in the base frame [mm]; `follow` draws it there."""
        self._end_mm = end_mm
        if self._drawn_end_mm is None:
            self._draw(end_mm)

    def follow(self, time_s: float) -> None:
        """Lets the cable hang to where it ends now, not more often than need be."""
        end_mm, drawn_mm = self._end_mm, self._drawn_end_mm
        if end_mm is None or drawn_mm is None or 0 <= time_s - self._drawn_at_s < _PERIOD_S:
            return
        if np.abs(end_mm - drawn_mm).max() >= _MOVED_MM:
            self._draw(end_mm)
            self._drawn_at_s = time_s

    def _draw(self, end_mm: NDArray[np.float64]) -> None:
        self._drawn_end_mm = end_mm
        self.pull_n = cable.pull_n(self._spec, self._start_mm, end_mm)
        line = cable.hanging(self._start_mm, end_mm, length_mm=self._spec.length_mm)
        middles, orientations = cable.along(line)
        self.node.batched_positions = (middles * METRES_PER_MM).astype(np.float32)
        self.node.batched_wxyzs = orientations.astype(np.float32)

    def show_flow(self, step: int | None) -> None:
        """Shows light pulses that run to the car, one link per step, or none."""
        pulse = None if step is None else step % _PULSE_SEGMENTS
        if pulse == self._pulse:
            return
        self._pulse = pulse
        colors = np.tile(np.array(CABLE, dtype=np.uint8), (cable.SEGMENTS, 1))
        if pulse is not None:
            distance = (np.arange(cable.SEGMENTS) - pulse) % _PULSE_SEGMENTS
            share = np.clip(1 - np.minimum(distance, _PULSE_SEGMENTS - distance) / 3, 0, 1)[:, None]
            colors = np.round(colors * (1 - share) + np.array(CHARGING) * share).astype(np.uint8)
        self.node.batched_colors = colors
