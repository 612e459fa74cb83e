"""Calibration routines as the API shows them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schema.base import Timestamp, VehicleId, Wire
from server.schema.calibrations import CalibrationsInForce
from server.schema.problem import Problem


class BeltReading(Wire):
    """How far a carriage really went, measured with a rule."""

    commanded_mm: Annotated[float, Field(ge=50, le=2000, allow_inf_nan=False)] = Field(
        description="By the board's counting, both ends approached from the same side"
    )
    measured_mm: Annotated[float, Field(ge=50, le=2000, allow_inf_nan=False)]
    reading_sigma_mm: Annotated[float, Field(ge=0.01, le=2, allow_inf_nan=False)] = Field(
        0.1, description="How exactly each end of the rule was read"
    )


LabelOwner = Annotated[
    VehicleId | None, Field(description="Not needed where there is only one vehicle")
]


class RobotRoutineRequest(Wire):
    """Measure the robot: 25 looks at the label of a vehicle that stands still."""

    kind: Literal["robot"] = "robot"
    vehicle_id: LabelOwner = None
    left_belt: BeltReading | None = None
    right_belt: BeltReading | None = Field(
        None, description="Without both the scale of everything is known to a quarter percent only"
    )
    label_sigma_mm: Annotated[float, Field(ge=0.01, le=2, allow_inf_nan=False)] = Field(
        0.15, description="How exactly the side of the printed label was measured"
    )


class SocketRoutineRequest(Wire):
    """Teach a socket: the plug has been brought all the way in, by jogging or by a job.

    The robot looks, draws the plug out along its axis, and looks again. It moves nowhere else.
    """

    kind: Literal["socket"] = "socket"
    vehicle_id: LabelOwner = None


class CheckRoutineRequest(Wire):
    """Check how exactly the robot goes where it is sent, in the terms of ISO 9283."""

    kind: Literal["check"] = "check"
    vehicle_id: LabelOwner = None
    approaches: Annotated[int, Field(ge=3, le=30)] = Field(
        3, description="Of each of nine places, from each of two directions"
    )


RoutineRequest = Annotated[
    RobotRoutineRequest | SocketRoutineRequest | CheckRoutineRequest, Field(discriminator="kind")
]


class RoutineLook(Wire):
    """One place from which the label was looked for."""

    x_mm: float = Field(description="Of the platform, as far as known")
    y_mm: float
    seen: bool


class Routine(Wire):
    """The routine under way, or the last one."""

    kind: Literal["robot", "socket", "check"]
    state: Literal["running", "interrupted", "finished", "failed", "cancelled"] = Field(
        description="An interrupted one can be resumed where it was"
    )
    doing: str = Field(description="In a sentence")
    done: int = Field(ge=0)
    total: int = Field(ge=0, description="Places to look from; 0 until they are chosen")
    looks: list[RoutineLook]
    begun_by: str
    begun_at: Timestamp
    calibration_id: str | None = Field(description="What came of it; nobody uses it yet")
    check_id: str | None = Field(default=None, description="The check that was made")
    problem: Problem | None = Field(description="Why it stands still, or has failed")


class CalibrationNow(Wire):
    """What counts, and what is being measured."""

    in_force: CalibrationsInForce = CalibrationsInForce()
    routine: Routine | None = None
