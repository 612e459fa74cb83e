"""Calibration routines as the API shows them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.calibration.grade import Grade
from server.schema.base import Timestamp, VehicleId, Wire
from server.schema.calibrations import CalibrationsInForce
from server.schema.drift import BeltDrift, MaintenanceHint
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
        None,
        description="Null: as the calibration in force has it, if a rule has told. Without both "
        "belts the scale of everything is known to a quarter percent only",
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


class SwitchesRoutineRequest(Wire):
    """Home again and again, and look each time where the platform then stands."""

    kind: Literal["switches"] = "switches"
    vehicle_id: LabelOwner = None
    approaches: Annotated[int, Field(ge=3, le=30)] = Field(5, description="Of each switch")


class PlayRoutineRequest(Wire):
    """Approach one place from both sides, with each carriage by itself."""

    kind: Literal["play"] = "play"
    vehicle_id: LabelOwner = None
    approaches: Annotated[int, Field(ge=3, le=30)] = Field(
        4, description="With each carriage, from each side"
    )


class BeltsRoutineRequest(Wire):
    """Measure with a rule how far both carriages go; asks for both readings on the way."""

    kind: Literal["belts"] = "belts"
    distance_mm: Annotated[float, Field(ge=50, le=400, allow_inf_nan=False)] = Field(
        300.0, description="By the board's counting"
    )
    reading_sigma_mm: Annotated[float, Field(ge=0.01, le=2, allow_inf_nan=False)] = Field(
        0.1, description="How exactly each end of the rule is read"
    )


class ForceRoutineRequest(Wire):
    """Measure the slide's friction from empty strokes and, against a spring, its force scale."""

    kind: Literal["force"] = "force"
    strokes: Annotated[int, Field(ge=2, le=20)] = Field(3, description="There and back")
    stroke_mm: Annotated[float, Field(ge=5, le=100, allow_inf_nan=False)] = Field(
        12.0, description="So far the plug goes out; nothing may stand there"
    )
    spring_n_mm: Annotated[float | None, Field(gt=0, le=50, allow_inf_nan=False)] = Field(
        None, description="Rate of a spring to push against; null: the force scale is not measured"
    )
    spring_sigma: Annotated[float, Field(ge=0.001, le=0.2, allow_inf_nan=False)] = Field(
        0.02, description="How exactly that rate is known, as a share of it"
    )


class CameraRoutineRequest(Wire):
    """Calibrate the camera with the printed board, held before it by hand; the robot stands."""

    kind: Literal["camera"] = "camera"
    square_mm: Annotated[float, Field(ge=5, le=200, allow_inf_nan=False)] = Field(
        24.0, description="Measured side of a square of the printed board"
    )


RoutineRequest = Annotated[
    CameraRoutineRequest
    | RobotRoutineRequest
    | SocketRoutineRequest
    | CheckRoutineRequest
    | SwitchesRoutineRequest
    | PlayRoutineRequest
    | BeltsRoutineRequest
    | ForceRoutineRequest,
    Field(discriminator="kind"),
]

RoutineKind = Literal["camera", "robot", "socket", "check", "switches", "play", "belts", "force"]


class RoutineLook(Wire):
    """One place from which the label was looked for."""

    x_mm: float = Field(description="Of the platform, as far as known")
    y_mm: float
    seen: bool


class RoutineInput(Wire):
    """A number that a person types in."""

    unit: Literal["mm", "N"]
    least: float
    most: float


class RoutineQuestion(Wire):
    """What a routine waits for. Nothing moves until it is answered."""

    code: str = Field(description="Stable", examples=["belts_marked"])
    text: str = Field(description="What to do, in a sentence or two")
    input: RoutineInput | None = Field(description="Null: it is enough to confirm")


class RoutineAnswer(Wire):
    """The answer to the question that a routine asks."""

    code: str = Field(description="Of the question: an older one is not answered by mistake")
    value: Annotated[float | None, Field(allow_inf_nan=False)] = None


class RoutineFigure(Wire):
    """One number that a routine has found."""

    code: str = Field(description="Stable", examples=["play_left_mm"])
    label: str = Field(description="In a few words")
    value: float
    sigma: float | None = Field(description="Its standard deviation; null: not known")
    unit: str = Field(description="Empty for a ratio", examples=["mm"])


class RoutineSetting(Wire):
    """One number of a request that may be chosen."""

    name: str = Field(examples=["approaches"])
    label: str
    unit: str
    least: float
    most: float
    usual: float | None = Field(description="Null: it is left out unless it is given")
    whole: bool = Field(description="Whole numbers only")


class RoutineDescription(Wire):
    """What there is to choose from."""

    kind: RoutineKind
    title: str
    what: str = Field(description="What the robot does, and what comes of it")
    before: list[str] = Field(description="What to do before it begins, in sentences")
    needs_label: bool = Field(description="A car with a label has to stand before the robot")
    settings: list[RoutineSetting]


class RoutineList(Wire):
    """All routines, in the order in which a new robot wants them."""

    routines: list[RoutineDescription]


class Routine(Wire):
    """The routine under way, or the last one."""

    kind: RoutineKind
    state: Literal["running", "interrupted", "finished", "failed", "cancelled"] = Field(
        description="An interrupted one can be resumed where it was"
    )
    doing: str = Field(description="In a sentence")
    done: int = Field(ge=0)
    total: int = Field(ge=0, description="Places to look from, or views; 0 until known")
    looks: list[RoutineLook]
    begun_by: str
    begun_at: Timestamp
    calibration_id: str | None = Field(description="What came of it; nobody uses it yet")
    check_id: str | None = Field(default=None, description="The check that was made")
    problem: Problem | None = Field(description="Why it stands still, or has failed")
    asks: RoutineQuestion | None = Field(
        default=None, description="What it waits for; null: for nobody"
    )
    verdict: Grade | None = Field(default=None, description="Of what came of it")
    remarks: list[str] = Field(
        default_factory=list, description="What keeps it from being better, with what to do"
    )
    figures: list[RoutineFigure] = Field(default_factory=list, description="What was found")


class CalibrationNow(Wire):
    """What counts, and what is being measured."""

    in_force: CalibrationsInForce = CalibrationsInForce()
    routine: Routine | None = None
    drift: BeltDrift | None = Field(default=None, description="What jobs have shown of the belts")
    hints: list[MaintenanceHint] = Field(
        default_factory=list, description="What wears, or has moved; empty: all is well"
    )
