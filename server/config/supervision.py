"""What is watched while the robot moves or is plugged in, and when it is stopped."""

from __future__ import annotations

from typing import Self

from pydantic import Field, model_validator

from server.config.section import Section


class SupervisionSettings(Section):
    """Ages, times and tolerances of the watchdogs; what they cannot see counts as unsafe."""

    telemetry_age_s: float = Field(
        0.4, ge=0.1, le=2, description="Older news of a moving robot stops it"
    )
    camera_age_s: float = Field(
        4.0, ge=0.5, le=30, description="A socket measured longer ago is measured again"
    )
    station_sample_s: float = Field(
        0.1, ge=0.02, le=1, description="The station is read so often while the plug may move"
    )
    station_age_s: float = Field(
        1.0, ge=0.2, le=10, description="Older readings say nothing about now"
    )
    proof_patience_s: float = Field(
        30.0, ge=1, le=300, description="So long the current may take to stop after the command"
    )
    charging_silence_s: float = Field(
        60.0, ge=5, le=600, description="A station may be silent for so long while the car charges"
    )
    following_error_mm: float = Field(
        2.0, gt=0, le=10, description="The slide may lag so far behind its set point"
    )
    stall_s: float = Field(
        0.06, ge=0.02, le=1, description="A slide that is told to move and does not has stalled"
    )
    stopping_s: float = Field(
        1.0, ge=0.1, le=5, description="A stopped robot stands still after this time"
    )
    standstill_mm: float = Field(
        0.5, gt=0, le=5, description="A stopped robot that moves further loses its power"
    )
    release_after_s: float = Field(
        3.0,
        ge=0,
        le=600,
        description="A stop that no person pressed ends so long after its cause, if that is "
        "harmless; 0: only a person ends it",
    )

    @model_validator(mode="after")
    def _readings_come_in_time(self) -> Self:
        if self.station_sample_s >= self.station_age_s:
            msg = "station_sample_s must be below station_age_s: no reading would ever be new"
            raise ValueError(msg)
        return self
