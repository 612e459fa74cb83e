"""What the simulated camera has in front of it at one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Pose = NDArray[np.float64]
"""Homogeneous transform, shape (4, 4), translation in mm. T_a_b maps b coordinates to a."""


@dataclass(frozen=True, slots=True, eq=False)
class RowWay:
    """How far the car is from its place in the view when the outermost rows see it.

    Attributes:
        first_mm: In the camera frame, when the first row sees it, shape (3,).
        last_mm: When the last row sees it, shape (3,).
    """

    first_mm: NDArray[np.float64]
    last_mm: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class CameraView:
    """The true scene in the camera frame (x right, y down, z forward).

    Attributes:
        T_camera_label: Pose of the QR label (origin its centre, x right, y down, z into the car).
        T_camera_socket: Pose of the socket (origin the centre of its face, z into the car).
        T_camera_plug: Pose of the plug (origin the centre of its tip, z the insertion axis).
        label_velocity_mm_s: Velocity of the label in the camera frame, shape (3,); blurs moving
            pictures.
        payload: Text in the label's QR code.
        label_size_mm: Outer side of the code without its quiet zone, as it is believed.
        row_way: The label's way while the rows are read out; None if only its velocity is known.
    """

    T_camera_label: Pose
    T_camera_socket: Pose
    T_camera_plug: Pose
    label_velocity_mm_s: NDArray[np.float64]
    payload: str
    label_size_mm: float
    row_way: RowWay | None = None
