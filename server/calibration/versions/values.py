"""What the calibrations in force mean for the parts of the robot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.config.camera import CameraDoubt, CameraSettings
from server.localisation.known_camera import KnownCamera
from server.schema.calibrations import (
    CalibrationValues,
    CameraValues,
    ForceValues,
    PlayValues,
    RobotValues,
    SocketValues,
)
from server.schema.vehicles import Vehicle
from server.storage.calibrations import WHOLE_ROBOT
from twin.as_built import PlanarAsBuilt
from twin.camera_mount import CameraMount

TURN_LEFT_DEG, PLATFORM_LEFT_MM = 0.5, 1.0
FOCAL_SHARE_LEFT, CENTRE_LEFT_PX = 0.002, 2.0
"""What a calibration leaves in doubt, for finding a label: several times what it really leaves."""


@dataclass(frozen=True, slots=True)
class ValuesInForce:
    """The numbers that count beside the configuration.

    Attributes:
        camera: None: as configured.
        robot: None: as configured.
        sockets: Of taught vehicles.
        play: None: never measured.
        force: None: never measured.
    """

    camera: CameraValues | None = None
    robot: RobotValues | None = None
    sockets: tuple[SocketValues, ...] = ()
    play: PlayValues | None = None
    force: ForceValues | None = None

    @classmethod
    def of(cls, values: Iterable[CalibrationValues]) -> Self:
        """Of the versions that count, at most one of a kind and vehicle."""
        all_of_them = list(values)
        return cls(
            next((one for one in all_of_them if isinstance(one, CameraValues)), None),
            next((one for one in all_of_them if isinstance(one, RobotValues)), None),
            tuple(one for one in all_of_them if isinstance(one, SocketValues)),
            next((one for one in all_of_them if isinstance(one, PlayValues)), None),
            next((one for one in all_of_them if isinstance(one, ForceValues)), None),
        )

    @property
    def mechanism(self) -> PlanarAsBuilt | None:
        """The built robot; None: as drawn."""
        return self.robot.mechanism if self.robot else None

    @property
    def force_scale(self) -> float:
        """Force that the board shows over the true one; 1 where nobody has measured it."""
        return self.force.shown_per_true if self.force is not None else 1.0

    def as_taught(self, vehicle: Vehicle) -> Vehicle:
        """A vehicle with its socket where it was taught, if it was."""
        for one in self.sockets:
            if one.vehicle_id == vehicle.id:
                return vehicle.model_copy(update={"socket": one.socket})
        return vehicle

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

    def known_camera(self, configured: CameraSettings) -> KnownCamera:
        """The camera, and what these calibrations leave in doubt of it."""
        doubt = configured.doubt
        if self.robot is not None:
            doubt = _at_most(doubt, turn_deg=TURN_LEFT_DEG, platform_mm=PLATFORM_LEFT_MM)
        if self.camera is not None:
            doubt = _at_most(doubt, focal_share=FOCAL_SHARE_LEFT, centre_px=CENTRE_LEFT_PX)
        return KnownCamera(self.optics(configured), self.mount(configured), doubt)


def _at_most(doubt: CameraDoubt, **left: float) -> CameraDoubt:
    smaller = {name: min(most, getattr(doubt, name)) for name, most in left.items()}
    return doubt.model_copy(update=smaller)


def subject_of(values: CalibrationValues) -> str:
    """Of a socket the vehicle; of the robot's own parts ""."""
    return values.vehicle_id if isinstance(values, SocketValues) else WHOLE_ROBOT


def rotation_vector(rotation: NDArray[np.float64]) -> tuple[float, float, float]:
    """Rotation vector [rad] of a rotation matrix, shape (3, 3)."""
    x, y, z = np.ravel(cv2.Rodrigues(rotation)[0]).tolist()
    return x, y, z


def rotation_matrix(vector_rad: tuple[float, float, float]) -> NDArray[np.float64]:
    """Rotation matrix, shape (3, 3), of a rotation vector [rad]."""
    return np.asarray(cv2.Rodrigues(np.array(vector_rad))[0], dtype=np.float64)
