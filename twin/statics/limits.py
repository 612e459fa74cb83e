"""What the motors can hold."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Force = Annotated[float, Field(gt=0, le=100_000, allow_inf_nan=False)]


class ActuatorLimits(BaseModel):
    """Largest force that each actuator may be asked for [N].

    The defaults are this project's own. Carriages: 0.4 N m of the stepper, geared 5.18:1 on a
    pulley of 36.576 mm circumference, would be 356 N without losses; 100 N leaves room for
    friction, acceleration and the belt. Slide: what its motor gives at full current.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    rho1_n: Force = Field(100.0, description="left carriage")
    rho2_n: Force = Field(100.0, description="right carriage")
    rho3_n: Force = Field(150.0, description="insertion slide")

    @property
    def joints(self) -> tuple[float, float, float]:
        """Limits of rho1, rho2, rho3 [N]."""
        return (self.rho1_n, self.rho2_n, self.rho3_n)


DEFAULT_LIMITS = ActuatorLimits()
