"""How fast each joint may move."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field

from twin.motion.errors import InvalidMotionError

Positive = Annotated[float, Field(gt=0, le=1_000_000, allow_inf_nan=False)]


class JointLimits(BaseModel):
    """Largest speed, acceleration and jerk of one joint, the same in both directions."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    velocity_mm_s: Positive
    acceleration_mm_s2: Positive
    jerk_mm_s3: Positive

    def scaled(self, speed_fraction: float) -> Self:
        """All three limits times a fraction: slower, with ramps that take as long as before."""
        return self.model_copy(
            update={
                "velocity_mm_s": self.velocity_mm_s * speed_fraction,
                "acceleration_mm_s2": self.acceleration_mm_s2 * speed_fraction,
                "jerk_mm_s3": self.jerk_mm_s3 * speed_fraction,
            }
        )


class MotionLimits(BaseModel):
    """Limits of the three joints.

    The defaults are this project's own. Carriages: a geared stepper at 1/8 microstep follows
    88 mm/s. Slide: 86 rpm on a screw with a lead of 10 mm give 14.3 mm/s.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    rho1: JointLimits = JointLimits(velocity_mm_s=80, acceleration_mm_s2=400, jerk_mm_s3=4000)
    rho2: JointLimits = JointLimits(velocity_mm_s=80, acceleration_mm_s2=400, jerk_mm_s3=4000)
    rho3: JointLimits = JointLimits(velocity_mm_s=14, acceleration_mm_s2=100, jerk_mm_s3=1500)

    @property
    def joints(self) -> tuple[JointLimits, JointLimits, JointLimits]:
        """Limits of rho1, rho2, rho3."""
        return (self.rho1, self.rho2, self.rho3)

    def scaled(self, speed_fraction: float) -> Self:
        """The limits for a slower motion, 0 < speed_fraction <= 1.

        Raises:
            InvalidMotionError: the fraction is not in that range.
        """
        if not 0 < speed_fraction <= 1:
            msg = f"a speed fraction must be greater than 0 and at most 1, not {speed_fraction:g}"
            raise InvalidMotionError(msg, {"speed_fraction": speed_fraction})
        return self.model_copy(
            update={
                "rho1": self.rho1.scaled(speed_fraction),
                "rho2": self.rho2.scaled(speed_fraction),
                "rho3": self.rho3.scaled(speed_fraction),
            }
        )
