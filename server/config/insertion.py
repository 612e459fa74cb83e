"""How the plug goes in and comes out."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, model_validator

from server.config.section import Section
from twin.force_band import ForceBand

Depth = Annotated[float, Field(ge=-30, le=100)]
Force = Annotated[float, Field(ge=-200, le=200)]
BandPoints = tuple[tuple[Depth, Force, Force], ...]

INSERTION_BAND: BandPoints = (
    (0.0, -10.0, 32.0),
    (16.0, -10.0, 40.0),
    (26.0, -10.0, 79.0),
    (31.0, 0.0, 79.0),
    (35.0, 15.0, 79.0),
    (38.0, 15.0, 79.0),
    (40.0, 5.0, 79.0),
)
WITHDRAWAL_BAND: BandPoints = (
    (0.0, -30.0, 15.0),
    (16.0, -40.0, 30.0),
    (30.0, -80.0, 79.0),
)


class InsertionSettings(Section):
    """Distances, forces and what the camera must know before the plug touches the socket.

    The paper asks for a depth of 40 +-20 mm, 20 (+10) mm from plug to socket before the insertion
    and 70 +-10 N; its location accuracy of 0.5 mm is five times the sigma that is asked for here.
    """

    depth_mm: float = Field(40.0, ge=20, le=60, description="Depth of a plug that is fully in")
    depth_tolerance_mm: float = Field(
        1.0, gt=0, le=10, description="Depth that may be missing when the plug counts as in"
    )
    pre_insertion_distance_mm: float = Field(
        20.0, ge=5, le=30, description="From plug tip to socket face when the insertion begins"
    )
    force_limit_n: float = Field(79.0, gt=0, le=150, description="Never push harder")
    withdrawal_force_limit_n: float = Field(80.0, gt=0, le=150, description="Never pull harder")
    contact_force_limit_n: float = Field(
        45.0, gt=0, le=150, description="Never push harder before the plug is guided by the socket"
    )
    guide_depth_mm: float = Field(
        8.0, ge=1, le=30, description="From this depth on the socket guides the plug"
    )
    band: BandPoints = Field(
        INSERTION_BAND,
        description="(Depth in mm, smallest and largest force in N) of a good insertion",
    )
    withdrawal_band: BandPoints = Field(
        WITHDRAWAL_BAND,
        description="The same while it comes out; a pull is negative",
    )
    end_stop_stiffness_n_mm: float = Field(
        40.0, gt=0, description="A force that rises so steeply is a hard stop, no rubbing contact"
    )
    search_tries: int = Field(
        5, ge=0, le=8, description="So often the plug tries again when it meets an obstacle"
    )
    search_radius_mm: float = Field(
        0.8, ge=0, le=3, description="It tries so far beside the measured place"
    )
    max_lateral_sigma_mm: float = Field(
        0.1, gt=0, le=1, description="Standard deviation of the socket's place, across the axis"
    )
    max_tilt_deg: float = Field(
        3.0, gt=0, le=10, description="Tilt of the socket that the plug holder can follow"
    )
    measurement_frames: int = Field(
        3, ge=1, le=20, description="Pictures that one measurement of the socket averages"
    )
    settle_s: float = Field(
        0.15, ge=0, le=5, description="Time the platform stands still before a measurement"
    )

    @model_validator(mode="after")
    def _bands_are_bands(self) -> Self:
        ForceBand(self.band)
        ForceBand(self.withdrawal_band)
        return self
