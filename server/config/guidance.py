"""How a driver is guided to the robot."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.config.section import Section


class GuidanceSettings(Section):
    """What counts as well parked, when the words change, and how often the camera looks.

    It only looks while somebody watches the page or asks the API, and never while the robot works.
    """

    enabled: bool = True
    driver_faces: Literal["robot", "away"] = Field(
        "robot",
        description="Cars come in nose first (robot) or backwards (away), unless a vehicle's own "
        "driver_faces says otherwise",
    )
    margin_mm: float = Field(
        10.0, ge=0, le=80, description="Inside the regular box and the reach, sideways and upwards"
    )
    depth_margin_mm: float = Field(
        5.0, ge=0, le=30, description="Travel of the slide that must be left at both ends"
    )
    certainty: float = Field(
        2.0, ge=1, le=5, description="Standard deviations of the place that must be inside, too"
    )
    skew_certainty: float = Field(
        2.5, ge=1, le=6, description="Standard deviations by which a skew must exceed the limit"
    )
    hysteresis_mm: float = Field(
        2.0, ge=0, le=20, description="How far outside the words stay as they are"
    )
    hold_s: float = Field(0.35, ge=0, le=5, description="A new state must last so long to be said")
    still_s: float = Field(0.8, gt=0, le=10, description="A car stands that has not moved for ...")
    still_mm: float = Field(2.5, gt=0, le=50, description="... so long by more than this")
    reaction_s: float = Field(
        0.7, ge=0, le=3, description="From the word to the foot on the brake, the page included"
    )
    braking_mm_s2: float = Field(1200.0, gt=0, le=10_000, description="How hard drivers brake then")
    slow_mm_s: float = Field(
        150.0, gt=0, le=2000, description="Fast enough for the last half metre"
    )
    lost_s: float = Field(1.0, gt=0, le=10, description="A label not seen for so long is lost")
    gone_s: float = Field(20.0, gt=0, le=120, description="And so long later nobody waits for it")
    settled_s: float = Field(12.0, gt=0, le=600, description="An arrival is over after standing so")
    tracking_period_s: float = Field(0.1, ge=0.03, le=2, description="A look at a car that moves")
    standing_period_s: float = Field(0.4, ge=0.03, le=10, description="A look at one that stands")
    search_period_s: float = Field(0.5, ge=0.03, le=10, description="A look for one")
    asked_s: float = Field(
        5.0, gt=0, le=60, description="How long a request to the API keeps the camera looking"
    )
