"""Rolling shutter: every row of the sensor sees the car at its own time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.view import CameraView, RowWay

_STILL_MM = 1e-6


def view_while_read_out(
    view_at: Callable[[float], CameraView], middle_s: float, readout_s: float
) -> CameraView:
    """The view in the middle of a frame, with the way of the car while its rows are read out.

    Args:
        view_at: The true scene at an event loop time [s].
        middle_s: When the middle row sees the scene, in the middle of its exposure.
        readout_s: From the first row to the last.
    """
    middle = view_at(middle_s)
    if readout_s == 0:
        return middle
    place = middle.T_camera_label[:3, 3]
    first = view_at(middle_s - readout_s / 2).T_camera_label[:3, 3] - place
    last = view_at(middle_s + readout_s / 2).T_camera_label[:3, 3] - place
    return replace(middle, row_way=RowWay(first, last))


class RowMotion:
    """Where the car is when a row sees it, compared with the middle of the frame.

    The way is the parabola through the first, middle and last row: exact at constant acceleration.
    The camera never turns, so car body, socket and label all move alike.

    Args:
        view: The scene.
        readout_s: Used with the label's velocity where the view does not know its way.
        height: Rows of the picture.
    """

    def __init__(self, view: CameraView, readout_s: float, height: int) -> None:
        half_mm = view.label_velocity_mm_s * (readout_s / 2)
        way = view.row_way or RowWay(-half_mm, half_mm)
        self._first, self._last = way.first_mm, way.last_mm
        self._height = height
        self.still = float(max(np.abs(self._first).max(), np.abs(self._last).max())) < _STILL_MM

    def offsets_mm(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement in the camera frame for row coordinates [px], shape (n, 3)."""
        s = (2 * rows / max(self._height - 1, 1) - 1)[:, None]
        return self._first * (s * s - s) / 2 + self._last * (s * s + s) / 2

    @property
    def extremes_mm(self) -> NDArray[np.float64]:
        """Displacements at the first, the middle and the last row, shape (3, 3)."""
        return np.stack((self._first, np.zeros(3), self._last))

    def correct(
        self,
        x_mm: NDArray[np.float32],
        y_mm: NDArray[np.float32],
        rows: NDArray[np.float64],
        T_camera_plane: NDArray[np.float64],
    ) -> None:
        """Turn plane coordinates, worked out for the middle of the frame, into each row's own.

        With the plane's axes e1, e2, its normal n, its origin t and a displacement d, the ray
        that met the plane at p = s r meets the displaced one at k p, k = 1 + (n d) / (n t), so
        x' = k x + (k - 1) e1 t - e1 d: exact, and one scale and shift for each row.

        Args:
            x_mm: Along the plane's x, shape (rows, columns); changed in place.
            y_mm: The same along its y.
            rows: Row coordinates [px], shape (rows,).
            T_camera_plane: Pose of the plane in the middle of the frame.
        """
        offsets = self.offsets_mm(rows)
        e1, e2, normal, origin = T_camera_plane[:3, :4].T
        grown = (offsets @ normal) / float(normal @ origin)
        scale = (1 + grown).astype(np.float32)[:, None]
        shift_x = grown * float(e1 @ origin) - offsets @ e1
        shift_y = grown * float(e2 @ origin) - offsets @ e2
        np.multiply(x_mm, scale, out=x_mm)
        np.multiply(y_mm, scale, out=y_mm)
        np.add(x_mm, shift_x.astype(np.float32)[:, None], out=x_mm)
        np.add(y_mm, shift_y.astype(np.float32)[:, None], out=y_mm)
