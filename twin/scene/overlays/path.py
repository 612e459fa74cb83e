"""The planned path of the plug's tip, coloured along its time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from viser import LineSegmentsHandle, SceneApi

from twin.scene.frames import METRES_PER_MM, metres
from twin.scene.nodes import add_label, add_pivot, set_text, set_visible
from twin.scene.overlays import PATH
from twin.scene.overlays.colors import EARLY_TO_LATE, ColorScale
from twin.scene.state import PlannedPath

LEAST_LENGTH_MM = 1.0
"""A shorter path is a point and is not drawn."""
PIECES = 48


def evenly_in_time(path: PlannedPath, pieces: int) -> tuple[NDArray[np.float64], ...]:
    """Times [s], shape (pieces + 1,), and tips [mm], shape (pieces + 1, 3), equally far in time.

    Where the robot is slow the points are close, so that the colours show the speed too.
    """
    times = np.linspace(0.0, path.duration_s, pieces + 1)
    tips = np.column_stack([np.interp(times, path.times_s, path.tips_mm[:, i]) for i in range(3)])
    return times, tips


def length_mm(path: PlannedPath) -> float:
    """Length of the way."""
    return float(np.linalg.norm(np.diff(path.tips_mm, axis=0), axis=1).sum())


class PathNodes:
    """A line with the time at its start and at its end."""

    def __init__(self, scene: SceneApi, name: str = PATH.nodes[0]) -> None:
        """Builds the nodes.

        Args:
            scene: Of the picture.
            name: Of the node that carries the way.
        """
        add_pivot(scene, name)
        self.way = add_pivot(scene, f"{name}/way", visible=False)
        self.line: LineSegmentsHandle = scene.add_line_segments(
            f"{name}/way/line",
            points=np.zeros((PIECES, 2, 3), dtype=np.float32),
            colors=np.zeros((PIECES, 2, 3), dtype=np.uint8),
            thickness=4.0,
            thickness_units="screen",
        )
        self.start = add_label(scene, f"{name}/way/start", "0 s", anchor="top-center")
        self.end = add_label(scene, f"{name}/way/end", "")
        self._shown: PlannedPath | None = None
        self._length_mm = 0.0

    def show(self, path: PlannedPath | None) -> None:
        """Draws a plan, once; hides the way while there is none."""
        if path is not None and path is not self._shown:
            self._shown = path
            self._length_mm = length_mm(path)
            self._draw(path)
        set_visible(self.way, visible=path is not None and self._length_mm >= LEAST_LENGTH_MM)

    def _draw(self, path: PlannedPath) -> None:
        times, tips = evenly_in_time(path, PIECES)
        points = (tips * METRES_PER_MM).astype(np.float32)
        colors = ColorScale(0.0, path.duration_s, EARLY_TO_LATE).rgb(times)
        self.line.points = np.stack([points[:-1], points[1:]], axis=1)
        self.line.colors = np.stack([colors[:-1], colors[1:]], axis=1)
        self.start.position = metres(tips[0])
        self.end.position = metres(tips[-1])
        set_text(self.end, f"{path.duration_s:.1f} s, {self._length_mm:.0f} mm")
