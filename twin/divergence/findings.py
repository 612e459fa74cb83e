"""What the comparison of model and robot finds."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Literal

from twin.joints import JointPosition


class Quantity(StrEnum):
    """What is compared."""

    RHO1 = "rho1"  # left carriage: steps counted against its set point
    RHO2 = "rho2"  # right carriage: the same
    RHO3 = "rho3"  # slide: encoder against its set point, through the slide's lag
    SET_POINT = "set_point"  # the board's set point against the plan it was sent
    FORCE = "force"  # force of the slide against a good insertion at this depth
    SOCKET = "socket"  # place of the socket against where it was first seen
    PHASE_TIME = "phase_time"  # length of a phase against its motions and its usual extra


Unit = Literal["mm", "N", "s"]


@dataclass(frozen=True, slots=True)
class Residual:
    """One comparison.

    Attributes:
        quantity: What is compared.
        expected: By the model.
        measured: On the robot.
        sigma: Standard deviation of the difference if nothing is wrong.
        unit: Of these three.
    """

    quantity: Quantity
    expected: float
    measured: float
    sigma: float
    unit: Unit

    @property
    def difference(self) -> float:
        """Measured minus expected."""
        return self.measured - self.expected

    @property
    def sigmas(self) -> float:
        """Size of the difference in standard deviations."""
        return abs(self.difference) / self.sigma


@dataclass(frozen=True, slots=True)
class Place:
    """Where in the job and where in space.

    Attributes:
        at_s: When.
        phase: Of the job; empty without one.
        joints: Measured.
        depth_mm: Plug tip behind the socket's face; None while that is not known.
        tip_off_mm: Distance of the plug's tip from where the model has it; None where that says
            nothing.
    """

    at_s: float
    phase: str
    joints: JointPosition
    depth_mm: float | None = None
    tip_off_mm: float | None = None


@dataclass(frozen=True, slots=True)
class Divergence:
    """Model and robot have parted by more than both are uncertain.

    Attributes:
        residual: The comparison that raised the alarm.
        place: Where and when that was.
        largest: The comparison with the largest difference so far.
    """

    residual: Residual
    place: Place
    largest: Residual

    @property
    def quantity(self) -> Quantity:
        """What is compared."""
        return self.residual.quantity


@dataclass(frozen=True, slots=True)
class Change:
    """An alarm began or ended.

    Attributes:
        divergence: As far as it is known now.
        began: True at its beginning, False at its end.
    """

    divergence: Divergence
    began: bool
