"""A flat sheet that somebody holds before the camera, such as the board that calibrates it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.textured_plane import PlaneTexture
from drivers.simulator.view import Pose, RowWay

_STEP_S = 0.005


@dataclass(frozen=True, slots=True, eq=False)
class PlacedSheet:
    """A sheet during one frame.

    Attributes:
        texture: What is printed on it.
        T_camera_sheet: Where it is in the middle of the frame, shape (4, 4) [mm].
        velocity_mm_s: Of its middle, shape (3,).
        way: Of its middle while the rows are read out. How it turns meanwhile is left out: of a
            hand that holds still that is nothing.
    """

    texture: PlaneTexture
    T_camera_sheet: Pose
    velocity_mm_s: NDArray[np.float64]
    way: RowWay


@dataclass(frozen=True, slots=True, eq=False)
class HeldSheet:
    """A sheet and the hand that holds it.

    Attributes:
        texture: What is printed on it; its middle is the origin of its frame, y down.
        pose_at: T_camera_sheet at an event loop time [s]; None: it is not before the camera.
    """

    texture: PlaneTexture
    pose_at: Callable[[float], Pose | None]

    def while_read_out(self, middle_s: float, readout_s: float) -> PlacedSheet | None:
        """Where it is during a frame; None: it is not before the camera.

        Args:
            middle_s: When the middle row sees it.
            readout_s: From the first row to the last.
        """
        middle = self.pose_at(middle_s)
        if middle is None:
            return None

        def moved_mm(by_s: float) -> NDArray[np.float64]:
            there = self.pose_at(middle_s + by_s)
            return np.zeros(3) if there is None else there[:3, 3] - middle[:3, 3]

        return PlacedSheet(
            self.texture,
            middle,
            (moved_mm(_STEP_S) - moved_mm(-_STEP_S)) / (2 * _STEP_S),
            RowWay(moved_mm(-readout_s / 2), moved_mm(readout_s / 2)),
        )


def printed_sheet(
    print_out: NDArray[np.uint8],
    texel_mm: float,
    black: float,
    white: float,
) -> PlaneTexture:
    """The texture of something printed.

    Args:
        print_out: Grey values of the print, 0 is ink, shape (h, w).
        texel_mm: Side of one of its pixels.
        black: Reflectance of the ink, 0 to 1.
        white: Reflectance of the paper, 0 to 1.
    """
    share = print_out.astype(np.float32) / np.float32(255)
    reflectance = np.float32(black) + np.float32(white - black) * share
    return PlaneTexture(reflectance, np.ones_like(reflectance), texel_mm)
