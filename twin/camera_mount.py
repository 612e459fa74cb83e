"""Where the camera sits on the platform."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

Offset = Annotated[float, Field(ge=-1000, le=1000, allow_inf_nan=False)]
Angle = Annotated[float, Field(ge=-2 * math.pi, le=2 * math.pi, allow_inf_nan=False)]


class CameraMount(BaseModel):
    """Pose of the camera (x right, y down, z forward) on the platform.

    The platform frame has its origin in V and axes parallel to the base frame; the platform only
    translates. The defaults put the camera beside the plug, 120 mm along the rail, looking at
    the car, so that a label 120 mm beside the socket is in the middle of the picture when the
    plug stands before the socket. They are this project's own; the paper gives none.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    x_mm: Offset = 120.0
    y_mm: Offset = -15.0
    z_mm: Offset = -50.0
    rotation_x_rad: Angle = 0.0
    rotation_y_rad: Angle = 0.0
    rotation_z_rad: Angle = math.pi

    @property
    def T_platform_camera(self) -> NDArray[np.float64]:  # noqa: N802 - a pose names both frames
        """Homogeneous transform, shape (4, 4), from the rotation vector and the offsets [mm]."""
        vector = np.array([self.rotation_x_rad, self.rotation_y_rad, self.rotation_z_rad])
        angle = float(np.linalg.norm(vector))
        pose = np.eye(4)
        if angle > 0:
            x, y, z = vector / angle
            cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
            # Rodrigues' formula
            pose[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        pose[:3, 3] = self.x_mm, self.y_mm, self.z_mm
        return pose
