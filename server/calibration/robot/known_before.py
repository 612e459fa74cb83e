"""What is known before the first look: the drawing, and how well a robot follows it."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

Sigma = Annotated[float, Field(gt=0, le=1000, allow_inf_nan=False)]
Ratio = Annotated[float, Field(ge=0.8, le=1.25, allow_inf_nan=False)]


class KnownBefore(BaseModel):
    """Standard deviations of the built robot about its drawing, and the measured travels.

    The defaults are a robot made of belts and printed parts. The scale of everything comes from
    here alone (`unknowns`), so measure it: a belt's travel over 400 mm with a rule, a label with
    a calliper.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    leg_sigma_mm: Sigma = Field(3.0, description="each of L1 and L2")
    foot_sigma_mm: Sigma = Field(5.0, description="right foot against the left, each axis")
    half_skew_sigma_rad: Sigma = Field(math.radians(0.5), description="of the rails")
    camera_sigma_rad: Sigma = Field(math.radians(4.0), description="attitude, each axis")
    left_scale: Ratio = Field(1.0, description="measured travel over the commanded one")
    right_scale: Ratio = Field(1.0, description="measured travel over the commanded one")
    scale_sigma: Sigma = Field(0.004, description="of both; 0.0004 once they are measured")
    label_ratio_sigma: Sigma = Field(0.0025, description="printed size over the entered one")
    switch_sigma_mm: Sigma = Field(0.01, description="how exactly homing finds each switch again")
    lens_sigma_rad: Sigma = Field(
        2e-4, description="centre of the picture over the focal length; 0.003 by the data sheet"
    )

    @property
    def scales(self) -> tuple[float, float]:
        """Left and right."""
        return self.left_scale, self.right_scale

    @property
    def sigma(self) -> NDArray[np.float64]:
        """In the order of the unknowns, shape (14,); infinite for the label's place."""
        return np.array(
            [
                self.leg_sigma_mm,
                self.leg_sigma_mm,
                self.foot_sigma_mm,
                self.foot_sigma_mm,
                self.half_skew_sigma_rad,
                self.scale_sigma,
                self.scale_sigma,
                *(self.camera_sigma_rad,) * 3,
                *(math.inf,) * 3,
                self.label_ratio_sigma,
            ]
        )
