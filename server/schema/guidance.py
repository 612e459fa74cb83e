"""Parking guidance as the API shows it. Left and right are the driver's."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire

State = Literal[
    "paused", "searching", "unreadable", "lost", "move", "stop", "good", "thin", "skewed"
]
Reason = Literal[
    "disabled",
    "robot_offline",
    "robot_busy",
    "robot_not_homed",
    "robot_not_parked",
    "plug_held",
    "camera_down",
    "nothing",
    "too_far",
    "too_dirty",
    "too_dark",
    "too_bright",
    "other_label",
    "twice",
    "mirrored",
    "no_vehicle",
    "hidden",
    "left_at_left",
    "left_at_right",
    "left_at_top",
    "left_at_bottom",
    "rolls",
    "too_fast",
    "askew",
    "stands",
    "too_low",
    "too_high",
    "stop",
    "good",
    "good_flawed",
    "thin",
    "skewed",
    "skewed_left",
    "skewed_right",
]
Point = tuple[float, float]


class GuidanceStep(Wire):
    """One thing to do."""

    direction: Literal["forward", "back", "left", "right", "up", "down"] = Field(
        description="As the driver sits; up and down cannot be driven"
    )
    distance_mm: float = Field(gt=0, description="As measured")
    shown_cm: int = Field(gt=0, description="Rounded so that it does not flicker")


class GuidedCar(Wire):
    """Where the car's socket is now, in the base frame (x along the rail, z out of the wall)."""

    vehicle_id: str
    x_mm: float
    y_mm: float
    z_mm: float
    sigma_x_mm: float = Field(
        ge=0, description="Standard deviation, what is common to all included"
    )
    sigma_z_mm: float = Field(ge=0)
    correlation_xz: float = Field(ge=-1, le=1)
    velocity_x_mm_s: float
    velocity_z_mm_s: float = Field(description="Negative towards the robot")
    still: bool
    skew_deg: float = Field(description="Between the socket's axis and the robot's")
    skew_sigma_deg: float = Field(ge=0)
    turned_deg: float = Field(description="About the vertical, positive to the driver's right")
    distance_mm: float = Field(ge=0, description="From the camera to the label")
    margin_mm: float | None = Field(
        description="Inside the good zone, uncertainty taken off; negative outside"
    )
    seen_at: Timestamp


class GuidanceZones(Wire):
    """Where a socket may be, from above: corners (x, z) in the base frame [mm]."""

    good: list[Point] = Field(description="In reach with a margin, inside the regular box")
    reachable: list[Point] = Field(description="In reach")
    stop_z_mm: float = Field(description="The best place of the socket's face")


class Guidance(Wire):
    """What the driver of an arriving car is told."""

    state: State
    since: Timestamp = Field(description="Since when in this state")
    arriving: bool = Field(
        description="A car is on its way in, or has just stopped: show it by itself"
    )
    reason: Reason = Field(description="What is said, for pages in another language")
    headline: str
    detail: str
    remedy: str = Field(description="What to do about a problem; empty without one")
    steps: list[GuidanceStep] = Field(description="What to do, the most important first")
    car: GuidedCar | None
    zones: GuidanceZones
    driver_faces: Literal["robot", "away"] = Field(
        description="This car, or any, comes in nose first or backwards"
    )
    max_skew_deg: float = Field(description="What the plug can follow")
