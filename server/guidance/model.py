"""The words of parking guidance: what was seen, where the car is, what the driver is told."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class GuidanceState(StrEnum):
    """What the driver is told, in one word."""

    PAUSED = "paused"  # the robot works, or the camera cannot say where it is
    SEARCHING = "searching"  # no label in sight
    UNREADABLE = "unreadable"  # there is something, but no place can be had from it
    LOST = "lost"  # the label was there a moment ago
    MOVE = "move"  # go so far that way
    STOP = "stop"  # brake now
    GOOD = "good"  # stands well: stay
    THIN = "thin"  # stands within reach, but near its edge
    SKEWED = "skewed"  # stands too askew for the plug


class PauseReason(StrEnum):
    """Why there is no guidance."""

    DISABLED = "disabled"
    ROBOT_OFFLINE = "robot_offline"
    ROBOT_BUSY = "robot_busy"
    ROBOT_NOT_HOMED = "robot_not_homed"
    ROBOT_NOT_PARKED = "robot_not_parked"
    PLUG_HELD = "plug_held"
    CAMERA_DOWN = "camera_down"


class Unseen(StrEnum):
    """Why a picture gave no place."""

    NOTHING = "nothing"
    TOO_FAR = "too_far"
    TOO_DIRTY = "too_dirty"
    TOO_DARK = "too_dark"
    TOO_BRIGHT = "too_bright"
    OTHER_LABEL = "other_label"
    TWICE = "twice"
    MIRRORED = "mirrored"
    NO_VEHICLE = "no_vehicle"


class Direction(StrEnum):
    """Where to, as the driver sits; up and down are for the installer."""

    FORWARD = "forward"
    BACK = "back"
    LEFT = "left"
    RIGHT = "right"
    UP = "up"
    DOWN = "down"


@dataclass(frozen=True, slots=True, eq=False)
class Sighting:
    """The socket as one picture shows it.

    Attributes:
        at_s: Middle of the exposure, event loop time.
        vehicle_id: Whose label it is.
        T_base_label: The label.
        place_mm: The socket's origin in the base frame, shape (3,).
        covariance_mm2: Of the place, what differs from picture to picture, shape (3, 3).
        lean: Components of the socket's axis across the insertion axis, along the rail and
            upwards, shape (2,): sines of small angles.
        lean_covariance: Of these, shape (2, 2).
        from_camera_mm: From the camera to the label in the base frame, shape (3,).
        flawed: The label can be read, but its edges do not fit: a job would refuse it.
        faces_robot: The vehicle comes in nose first; None if nothing is known of it.
    """

    at_s: float
    vehicle_id: str
    T_base_label: Array
    place_mm: Array
    covariance_mm2: Array
    lean: Array
    lean_covariance: Array
    from_camera_mm: Array
    flawed: bool = False
    faces_robot: bool | None = None


@dataclass(frozen=True, slots=True, eq=False)
class CarEstimate:
    """Where the car's socket is, and what is about to become of it.

    Attributes:
        at_s: Of the last sighting.
        vehicle_id: Whose car it is.
        place_mm: The socket's origin in the base frame, shape (3,).
        covariance_mm2: Of the place, errors common to all pictures included, shape (3, 3).
        velocity_mm_s: Of the socket, shape (3,).
        braking_mm_s2: How hard it slows down; negative while it gains speed.
        still: It has not moved for the time that the settings ask for.
        skew_rad: Angle between the socket's axis and the robot's.
        skew_sigma_rad: Its standard deviation.
        turned_rad: The part of it about the vertical, positive if the car is turned to its
            driver's right, whether it came in nose or tail first.
        distance_mm: From the camera to the label.
        flawed: The label does not look as it should.
        faces_robot: Its driver sits with the face to the robot.
    """

    at_s: float
    vehicle_id: str
    place_mm: Array
    covariance_mm2: Array
    velocity_mm_s: Array
    braking_mm_s2: float
    still: bool
    skew_rad: float
    skew_sigma_rad: float
    turned_rad: float
    distance_mm: float
    flawed: bool
    faces_robot: bool

    @property
    def approach_mm_s(self) -> float:
        """Speed towards the robot; negative away from it."""
        return -float(self.velocity_mm_s[2])


@dataclass(frozen=True, slots=True)
class Step:
    """One thing to do."""

    direction: Direction
    distance_mm: float
    shown_cm: int
