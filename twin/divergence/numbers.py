"""What the model expects of a good robot, and how sure it is of that.

Every sigma is a standard deviation and belongs to the model, not to one sample: it covers what
differs from one good robot, car or socket to the next. The defaults are this project's own
estimates unless a source is named.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

Positive = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]
Curve = tuple[tuple[NotNegative, NotNegative], ...]


class Numbers(BaseModel):
    """Base of all groups: immutable, and a misspelt name is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class TrackingNumbers(Numbers):
    """How the joints follow their set points."""

    slide_lag_s: Positive = Field(0.02, description="Time constant of the slide's control")
    slide_lag_sigma_s: NotNegative = Field(0.004, description="Its spread, load included")
    sample_sigma_s: NotNegative = Field(
        0.001, description="Set point and measurement of one sample are this much apart in time"
    )
    rail_sigma_mm: Positive = Field(0.01, description="Steps and their rounding")
    slide_sigma_mm: Positive = Field(0.02, description="Encoder counts and what control leaves")
    slide_give_mm_n: NotNegative = Field(
        0.0005, description="What the slide's control gives way under load"
    )


class SetPointNumbers(Numbers):
    """When the board should be where on the plan."""

    start_delay_s: NotNegative = Field(0.01, description="From sending a motion to its beginning")
    delay_sigma_s: Positive = Field(0.015, description="Spread of that delay")
    sigma_mm: Positive = Field(0.02, description="Rounding of the board's set point")


class ForceNumbers(Numbers):
    """Force of the slide over the depth of the plug.

    The requirement of 70 +-10 N is read as three standard deviations: a good socket differs from
    the nominal one by 3.3 N at its worst depth, 4.8 %.
    """

    peak_n: Positive = Field(70.0, description="Insertion force at the worst depth")
    peak_sigma: NotNegative = Field(0.048, description="Relative spread of good sockets")
    engagement: Curve = Field(
        ((0, 0), (2, 0.09), (4, 0.04), (18, 0.08), (30, 0.5), (36, 1), (38, 1), (40, 0.6)),
        description="(Depth in mm, share of the peak) while the plug goes in",
    )
    withdrawal: Curve = Field(
        ((0, 0), (4, 0.04), (18, 0.08), (30, 0.3), (36, 0.7), (38, 0.95), (40, 0.95)),
        description="The same while it comes out",
    )
    depth_sigma_mm: Positive = Field(0.3, description="Of the face, on top of the measurement")
    friction_n: NotNegative = Field(1.5, description="Of the slide itself")
    friction_sigma_n: Positive = Field(
        1.5, description="Spread of that, with weight and inertia along the axis"
    )
    noise_n: Positive = Field(0.8, description="Of one sample")
    slowest_mm_s: Positive = Field(1.0, description="Slower than this the force says nothing")

    @model_validator(mode="after")
    def _curves_ascend(self) -> Self:
        for curve in (self.engagement, self.withdrawal):
            if len(curve) < 2 or any(b[0] <= a[0] for a, b in pairwise(curve)):
                raise ValueError("a curve needs two or more points of ascending depth")
        return self


class PhaseTime(Numbers):
    """Time that a phase needs besides its motions."""

    typical_s: NotNegative
    sigma_s: Positive


class TimeNumbers(Numbers):
    """How long each phase should take; phases that are not named may take as long as they like."""

    phases: dict[str, PhaseTime] = Field(
        default_factory=lambda: {
            "locating": PhaseTime(typical_s=1.0, sigma_s=1.0),
            "aligning": PhaseTime(typical_s=0.8, sigma_s=0.5),
            "inserting": PhaseTime(typical_s=0.5, sigma_s=0.3),
            "plugged": PhaseTime(typical_s=0.2, sigma_s=0.7),
            "releasing": PhaseTime(typical_s=2.0, sigma_s=2.0),
            "withdrawing": PhaseTime(typical_s=0.4, sigma_s=0.25),
            "parking": PhaseTime(typical_s=0.15, sigma_s=0.15),
        },
        description="On top of the time that the planned motions take",
    )


class SocketNumbers(Numbers):
    """How much the place of a standing car's socket may seem to change."""

    model_sigma_mm: Positive = Field(0.08, description="What calibration leaves over")
    model_sigma_fraction: NotNegative = Field(
        0.001, description="The same, per millimetre that the platform has moved in between"
    )


class AlarmNumbers(Numbers):
    """When a difference becomes an alarm, and when it is over."""

    raise_sigmas: Positive = Field(4.0, description="Differences above this count")
    raise_after_s: NotNegative = Field(0.04, description="For this long, without a break")
    raise_samples: Annotated[int, Field(ge=1, le=1000)] = Field(
        5, description="And in this many samples; one sighting of the socket is enough"
    )
    clear_sigmas: Positive = Field(2.5, description="Differences below this are agreement")
    clear_after_s: NotNegative = Field(0.5, description="For this long, without a break")

    @model_validator(mode="after")
    def _clears_below_raise(self) -> Self:
        if self.clear_sigmas >= self.raise_sigmas:
            raise ValueError("clear_sigmas must be below raise_sigmas")
        return self


class DivergenceNumbers(Numbers):
    """All of them."""

    tracking: TrackingNumbers = TrackingNumbers()
    set_point: SetPointNumbers = SetPointNumbers()
    force: ForceNumbers = ForceNumbers()
    time: TimeNumbers = Field(default_factory=TimeNumbers)
    socket: SocketNumbers = SocketNumbers()
    alarm: AlarmNumbers = AlarmNumbers()

    def for_clock(self, speed: float) -> Self:
        """The same expectations of a simulation that runs ``speed`` times as fast as the wall.

        What a phase needs besides its motions is computing and writing, and that takes so much
        longer in the simulation's own time.
        """
        factor = max(speed, 1.0)
        phases = {
            name: PhaseTime(typical_s=usual.typical_s * factor, sigma_s=usual.sigma_s * factor)
            for name, usual in self.time.phases.items()
        }
        return self.model_copy(update={"time": TimeNumbers(phases=phases)})
