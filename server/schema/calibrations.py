"""Calibrations as the API shows them, and the words for them inside."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field

from drivers.camera.model import CameraModel
from server.calibration.grade import Grade
from server.schema.base import Timestamp, VehicleId, Wire
from server.schema.vehicles import SocketOffset
from twin.as_built import PlanarAsBuilt

Radians = Annotated[float, Field(ge=-6.3, le=6.3, allow_inf_nan=False)]
Millimetres = Annotated[float, Field(ge=-10_000, le=10_000, allow_inf_nan=False)]
Vector = tuple[Millimetres, Millimetres, Millimetres]
CovarianceTerm = Annotated[float, Field(allow_inf_nan=False)]


class CalibrationKind(StrEnum):
    """What is calibrated. Of each kind, and of sockets for each vehicle, one version counts."""

    CAMERA = "camera"
    ROBOT = "robot"
    SOCKET = "socket"
    SWITCHES = "switches"
    PLAY = "play"
    FORCE = "force"

    @property
    def unit(self) -> str:
        """Of its errors."""
        return {CalibrationKind.CAMERA: "px", CalibrationKind.FORCE: "N"}.get(self, "mm")


class CameraValues(Wire):
    """The camera's own numbers."""

    kind: Literal["camera"] = "camera"
    camera: CameraModel


class RobotValues(Wire):
    """The mechanism, and how the camera on it is turned.

    Where on the platform the camera sits, no motion of the robot tells: that stays as configured.
    """

    kind: Literal["robot"] = "robot"
    mechanism: PlanarAsBuilt
    camera_rotation_rad: tuple[Radians, Radians, Radians] = Field(
        description="Rotation vector of the camera on the platform"
    )


class SocketValues(Wire):
    """Where the socket of one vehicle is beside its label, as taught with this robot.

    It takes the place of what the vehicle's settings say.
    """

    kind: Literal["socket"] = "socket"
    vehicle_id: VehicleId
    socket: SocketOffset


Spread = Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)]
Newtons = Annotated[float, Field(ge=-500, le=500, allow_inf_nan=False)]


class SwitchesValues(Wire):
    """How well the limit switches of the carriages repeat.

    The slide's own switch no camera sees: the plug's depth is measured before each insertion.
    """

    kind: Literal["switches"] = "switches"
    left_spread_mm: Spread = Field(description="Standard deviation of where it closes")
    left_sigma_mm: Spread = Field(description="How sure that is")
    right_spread_mm: Spread
    right_sigma_mm: Spread
    approaches: Annotated[int, Field(ge=3, le=1000)]


class PlayValues(Wire):
    """Play of the carriages, and how far each lags behind its set point while it moves."""

    kind: Literal["play"] = "play"
    left_mm: Millimetres
    left_sigma_mm: Spread
    right_mm: Millimetres
    right_sigma_mm: Spread
    left_following_mm: Spread = Field(description="Largest distance to the set point, moving")
    right_following_mm: Spread


class ForceValues(Wire):
    """The slide as its own force gauge, in newtons as the board shows them.

    With the scale of a version in force, everybody but the board counts in true newtons.
    """

    kind: Literal["force"] = "force"
    friction_n: Newtons = Field(description="Half of what differs between out and back")
    friction_sigma_n: Spread
    offset_n: Newtons = Field(description="Mean of both: what the gauge shows without any force")
    offset_sigma_n: Spread
    scale: Annotated[float, Field(ge=0.2, le=5, allow_inf_nan=False)] = Field(
        1.0, description="Shown force over the true one"
    )
    scale_sigma: Spread | None = Field(None, description="Null: the scale was not measured")
    following_mm: Spread = Field(description="How far the slide lags behind its set point at most")

    @property
    def shown_per_true(self) -> float:
        """Force that the board shows over the true one; 1 where no spring has told."""
        return self.scale if self.scale_sigma is not None else 1.0


CalibrationValues = Annotated[
    CameraValues | RobotValues | SocketValues | SwitchesValues | PlayValues | ForceValues,
    Field(discriminator="kind"),
]


Provenance = Literal["routine", "drift"]


class LookRecord(Wire):
    """One look at the label, and how it fits to the calibration."""

    rho1_mm: Millimetres = Field(description="As the board counts")
    rho2_mm: Millimetres
    label_mm: Vector = Field(description="In the camera frame")
    covariance_mm2: Annotated[list[CovarianceTerm], Field(min_length=9, max_length=9)] = Field(
        description="Of label_mm, row by row"
    )
    residual_mm: Vector = Field(description="Seen less predicted, camera frame")
    weight: float = Field(ge=0, le=1, description="1; less for a look that does not fit")


class RobotEvidence(Wire):
    """What a calibration of the robot rests on."""

    looks: list[LookRecord]
    sigma: dict[str, float] = Field(description="Standard deviation of each unknown")
    unseen: list[str] = Field(description="What the looks could not tell, in sentences")
    duration_s: float = Field(ge=0, description="Robot time")
    provenance: Provenance = Field(
        default="routine", description="A routine has looked, or jobs have on their way (drift)"
    )
    tip_likely_mm: float | None = Field(
        default=None,
        ge=0,
        description="What the plug's tip then misses in 95 % of the regular box, as likely more as "
        "less; null: made before this was worked out",
    )
    tip_at_most_mm: float | None = Field(
        default=None, ge=0, description="The same, and no more in 95 of 100 such calibrations"
    )


class CameraViewRecord(Wire):
    """One picture of the board, and how it fits to the calibration."""

    rms_px: float = Field(ge=0, description="Root mean square residual of its corners")
    tilt_rad: float = Field(description="Between the board and the plane of the picture")
    distance_mm: float = Field(ge=0)
    used: bool = Field(description="False: it does not fit to the others and was left out")


class CameraEvidence(Wire):
    """What a calibration of the camera rests on."""

    views: list[CameraViewRecord]
    coverage: list[list[int]] = Field(
        description="How many corners were in each cell of a grid over the picture, by rows"
    )
    sigma: dict[str, float] = Field(description="Standard deviation of each number")
    rms_px: float = Field(ge=0, description="Root mean square residual of all corners")
    check_px: float = Field(ge=0, description="The same on pictures that were held back")


class Calibration(Wire):
    """One version. It never changes."""

    id: str
    kind: CalibrationKind
    version: int = Field(ge=1, description="Counted from 1, of each kind and vehicle")
    values: CalibrationValues
    grade: Grade
    remarks: list[str] = Field(description="What keeps it from being better, with what to do")
    error: float | None = Field(
        description="What it misses on data held back, in mm, (camera) px or (force) N; "
        "null: not measured"
    )
    error_in_use: float | None = Field(
        description="What the one then in force missed on the same data"
    )
    made_at: Timestamp
    made_by: str
    source: str = Field(description="Where its numbers come from, in words")
    in_force: bool


class CalibrationDetail(Calibration):
    """One version with what it rests on."""

    evidence: RobotEvidence | None
    camera_evidence: CameraEvidence | None = Field(
        default=None, description="Null: not of a camera, or its numbers come from elsewhere"
    )


class CalibrationPage(Wire):
    """Calibrations, newest first."""

    items: list[Calibration]
    next_cursor: str | None = Field(
        default=None, description="Pass as ?cursor= for the next page; null: end"
    )


class CalibrationsInForce(Wire):
    """What counts now; null: what the configuration says."""

    camera: Calibration | None = None
    robot: Calibration | None = None
    sockets: list[Calibration] = Field(default_factory=list, description="Of taught vehicles")
    switches: Calibration | None = None
    play: Calibration | None = None
    force: Calibration | None = None


class CalibrationEntry(Wire):
    """Numbers from elsewhere, such as a file of `plugpilot calibrate camera`."""

    values: CalibrationValues
    source: Annotated[str, Field(min_length=1, max_length=200, examples=["camera-0003.toml"])]


class Activation(Wire):
    """Put a version in force."""

    accept_worse: bool = Field(
        default=False, description="Also if it is worse than the one in force, or was not measured"
    )


class RollBack(Wire):
    """Go back to what was in force before."""

    kind: CalibrationKind
    vehicle_id: VehicleId | None = Field(None, description="Of a socket: whose")
