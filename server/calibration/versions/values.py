"""What the calibrations in force mean for the parts of the robot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.config.camera import CameraSettings
from server.schema.calibrations import CalibrationValues, CameraValues, RobotValues
from twin.as_built import PlanarAsBuilt
from twin.camera_mount import CameraMount


@dataclass(frozen=True, slots=True)
class ValuesInForce:
    """The numbers that count beside the configuration.

    Attributes:
        camera: None: as configured.
        robot: None: as configured.
    """

    camera: CameraValues | None = None
    robot: RobotValues | None = None

    @classmethod
    def of(cls, values: Iterable[CalibrationValues]) -> Self:
        """Of the versions that count, at most one of a kind."""
        by_kind = {one.kind: one for one in values}
        camera, robot = by_kind.get("camera"), by_kind.get("robot")
        return cls(
            camera if isinstance(camera, CameraValues) else None,
            robot if isinstance(robot, RobotValues) else None,
        )

    @property
    def mechanism(self) -> PlanarAsBuilt | None:
        """The built robot; None: as drawn."""
        return self.robot.mechanism if self.robot else None

    def optics(self, configured: CameraSettings) -> CameraModel:
        """The camera's own numbers."""
        return self.camera.camera if self.camera else configured.optics

    def mount(self, configured: CameraSettings) -> CameraMount:
        """Where the camera sits, as configured, and how it is turned."""
        if self.robot is None:
            return configured.mount
        x, y, z = self.robot.camera_rotation_rad
        turned = {"rotation_x_rad": x, "rotation_y_rad": y, "rotation_z_rad": z}
        return configured.mount.model_copy(update=turned)


def rotation_vector(rotation: NDArray[np.float64]) -> tuple[float, float, float]:
    """Rotation vector [rad] of a rotation matrix, shape (3, 3)."""
    x, y, z = np.ravel(cv2.Rodrigues(rotation)[0]).tolist()
    return x, y, z


def rotation_matrix(vector_rad: tuple[float, float, float]) -> NDArray[np.float64]:
    """Rotation matrix, shape (3, 3), of a rotation vector [rad]."""
    return np.asarray(cv2.Rodrigues(np.array(vector_rad))[0], dtype=np.float64)
