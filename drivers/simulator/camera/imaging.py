"""Numbers that describe how the simulated camera turns light into grey values."""

from __future__ import annotations

import math
from enum import StrEnum
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from drivers.camera import CameraModel

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]


class CameraFault(StrEnum):
    """What can be wrong with a camera."""

    NONE = "none"
    UNPLUGGED = "unplugged"
    """CameraMissingError at once, until it is plugged in again."""

    STALLED = "stalled"
    """No frame arrives any more: CameraTimeoutError after a second."""

    FROZEN = "frozen"
    """Frames keep coming with new times and numbers, but always the same picture; after ten of
    them CameraFrozenError, as from a real camera."""

    DARK = "dark"
    """No light: a covered lens, or night without a lamp."""

    OVEREXPOSED = "overexposed"
    """Far too much light: the sun in the lens."""

    WRONG_RESOLUTION = "wrong_resolution"
    """Another program has switched the camera to another mode: WrongResolutionError."""


class ImagingParameters(BaseModel):
    """Exposure, blur, light and noise. The defaults describe a Raspberry Pi camera v2.

    Lens and sensor: focal length 3.04 mm, f/2.0, 1640 x 1232 binned pixels whose rows are read
    one after the other every 18.9 us. Light, noise and reflectances are this project's own choice
    for a garage with a lamp.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    frames_per_s: Positive = 30.0
    exposure_s: Positive = 0.008
    readout_s: float = Field(
        0.0233, ge=0, le=1, description="from the first row's read-out to the last one's"
    )
    latency_s: float = Field(
        0.022, ge=0, le=1, description="from the last row's read-out to the delivered frame"
    )

    focus_distance_mm: Positive = 360.0
    focal_length_mm: Positive = 3.04
    f_number: Positive = 2.0
    lens_blur_px: Positive = Field(
        0.55, description="standard deviation of lens and pixel aperture at the focus distance"
    )

    ambient: float = Field(1.0, ge=0, le=100, description="light, 1 is a normally lit garage")
    illumination_gradient: Share = Field(0.25, description="change of light across the width")
    vignetting: Share = Field(1.0, description="share of the natural cos^4 fall-off")
    white_reflectance: Share = 0.85
    black_reflectance: Share = 0.05

    exposed_white: Share = Field(
        0.25, description="share of full well that white reaches at ambient 1 and 8 ms"
    )
    full_well_electrons: Positive = 10_000.0
    read_noise_electrons: float = Field(6.0, ge=0, allow_inf_nan=False)
    target_white: Share = Field(0.75, description="linear output that exposure and gain aim at")
    most_gain: float = Field(16.0, ge=1, le=256)
    gamma: Positive = 2.2

    automatic_exposure: bool = Field(
        default=False,
        description="exposure and gain follow the light; otherwise they stay as set for ambient",
    )
    shortest_exposure_s: Positive = 0.0002
    longest_exposure_s: Positive = Field(0.03, description="of the automatic exposure")
    exposure_step_stops: Positive = Field(0.25, description="the automatic exposure's resolution")
    exposure_most_stops: Positive = Field(1.0, description="its largest change at a time")
    exposure_period_frames: int = Field(4, ge=1, le=100, description="frames between its changes")
    exposure_delay_frames: int = Field(
        3, ge=0, le=100, description="age of the frame whose brightness it acts upon"
    )

    @model_validator(mode="after")
    def _exposures_are_ordered(self) -> Self:
        if self.shortest_exposure_s > self.longest_exposure_s:
            raise ValueError("shortest_exposure_s must not exceed longest_exposure_s")
        return self

    def disc_px(self, distance_mm: float, optics: CameraModel) -> float:
        """Diameter of the circle of confusion of a point at a distance from the lens [px].

        A thin lens of focal length f and aperture A = f / N, focused at d_f, spreads a point at d
        over a disc of diameter c = A f |d - d_f| / (d (d_f - f)) on the sensor.
        """
        focal_mm, focus_mm = self.focal_length_mm, self.focus_distance_mm
        aperture_mm = focal_mm / self.f_number
        beside_focus = abs(distance_mm - focus_mm) / (distance_mm * (focus_mm - focal_mm))
        return aperture_mm * focal_mm * beside_focus * optics.fx / focal_mm

    def blur_px(self, distance_mm: float, optics: CameraModel) -> float:
        """Standard deviation of the whole blur of a point at a distance from the lens [px].

        A disc of diameter c has the variance c^2 / 16 along each axis.
        """
        return math.hypot(self.lens_blur_px, self.disc_px(distance_mm, optics) / 4)
