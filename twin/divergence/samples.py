"""What the model is told about the robot: plain values, without drivers or jobs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twin.joints import JointPosition, JointVelocity


@dataclass(frozen=True, slots=True)
class Sample:
    """One telemetry sample of a robot that knows its position.

    Attributes:
        at_s: When it was taken.
        measured: Step counters of the carriages, encoder of the slide [mm].
        commanded: Set point at the same instant [mm].
        velocity: Velocity of the set point.
        force_n: Force of the slide, positive when it pushes towards the car.
        following: The board follows segments, or rests where they ended: it is neither homing,
            stopping nor in a fault, when the set point goes its own way.
        running: Segments are being executed.
        contact_known: The plug moves freely, or in a socket whose place is known.
    """

    at_s: float
    measured: JointPosition
    commanded: JointPosition
    velocity: JointVelocity
    force_n: float
    following: bool
    running: bool
    contact_known: bool


@dataclass(frozen=True, slots=True)
class Entry:
    """Where the plug meets the socket.

    Attributes:
        face_rho3_mm: The slide's position with the plug's tip level with the socket's face.
        sigma_mm: Standard deviation of that measurement.
    """

    face_rho3_mm: float
    sigma_mm: float


@dataclass(frozen=True, slots=True)
class Sighting:
    """The socket as a picture shows it.

    Attributes:
        at_s: When the picture was taken.
        place_mm: Centre of the socket's face in the base frame, shape (3,).
        covariance_mm2: Of that place, shape (3, 3).
        joints: Where the robot stood.
    """

    at_s: float
    place_mm: NDArray[np.float64]
    covariance_mm2: NDArray[np.float64]
    joints: JointPosition
