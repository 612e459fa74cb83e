"""Numbers that describe how the simulated camera turns light into grey values."""

from __future__ import annotations

import math
from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from drivers.camera import CameraModel

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]


class CameraFault(StrEnum):
    """What can be wrong with a camera."""

    NONE = "none"
    UNPLUGGED = "unplugged"
    """The driver reports an error at once."""

    STALLED = "stalled"
    """No frame arrives any more."""

    FROZEN = "frozen"
    """Frames keep coming with new times and numbers, but always the same picture."""

    DARK = "dark"
    """No light: a covered lens, or night without a lamp."""


class ImagingParameters(BaseModel):
    """Exposure, blur, light and noise. The defaults describe a Raspberry Pi camera v2.

    Lens and sensor: focal length 3.04 mm, f/2.0, 1640 x 1232 binned pixels. Light, noise and
    reflectances are this project's own choice for a garage with a lamp.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    frames_per_s: Positive = 30.0
    exposure_s: Positive = 0.008
    latency_s: float = Field(
        0.045, ge=0, le=1, description="from the end of exposure to the delivered frame"
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
    target_white: Share = Field(0.75, description="linear output the automatic gain aims at")
    most_gain: float = Field(16.0, ge=1, le=256)
    gamma: Positive = 2.2

    def blur_px(self, distance_mm: float, optics: CameraModel) -> float:
        """Standard deviation of the blur of a point at a distance from the lens [px].

        The blur disc of a thin lens has the diameter f^2 / N |1/d - 1/d_focus| on the sensor;
        a disc of diameter D has the variance D^2 / 16 along each axis.
        """
        pixels_per_mm = optics.fx / self.focal_length_mm
        aperture_mm = self.focal_length_mm / self.f_number
        disc_mm = (
            aperture_mm * self.focal_length_mm * abs(1 / distance_mm - 1 / self.focus_distance_mm)
        )
        return math.hypot(self.lens_blur_px, disc_mm * pixels_per_mm / 4)
