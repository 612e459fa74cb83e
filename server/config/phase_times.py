"""How long the phases of a job take on a robot that has done none yet."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class PhaseTimeSettings(Section):
    """What it takes on a robot as drawn; what this robot's own jobs took outranks it.

    Only the time left that people are shown rests on these: nothing waits or gives up by them.
    """

    preflight_s: float = Field(0.1, ge=0, le=3600, description="Checking, when nothing moves")
    preflight_with_homing_s: float = Field(
        20.0, ge=0, le=3600, description="Checking, finding the zero of each axis, and parking"
    )
    locating_s: float = Field(0.1, ge=0, le=3600, description="The label in the first picture")
    aligning_s: float = Field(3.0, ge=0, le=3600, description="To the socket, and measuring there")
    inserting_s: float = Field(5.0, ge=0, le=3600, description="In at the first try")
    releasing_s: float = Field(1.0, ge=0, le=3600, description="Until no current flows, unlocked")
    withdrawing_s: float = Field(4.9, ge=0, le=3600, description="Out of the socket")
    parking_s: float = Field(3.8, ge=0, le=3600, description="To the parking place")
