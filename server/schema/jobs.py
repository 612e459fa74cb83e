"""Jobs as the API shows them."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, AwareDatetime, Field, model_validator

from server.jobs.model import JobPhase, JobState, JobType, PersonChoice
from server.schema.base import Timestamp, VehicleId, Wire
from server.schema.problem import Problem


def _in_the_calendar(date: datetime) -> datetime:
    """The same instant in UTC; refuses what only another offset keeps within the calendar."""
    try:
        return date.astimezone(UTC)
    except OverflowError:
        raise ValueError("this date is out of range") from None


ScheduledTime = Annotated[
    AwareDatetime,
    AfterValidator(_in_the_calendar),
    Field(
        description="With the offset from UTC, so that a change to summer time changes nothing",
        examples=["2026-10-25T06:30:00+01:00"],
    ),
]


class JobRequest(Wire):
    """A job to be done."""

    type: JobType
    vehicle_id: VehicleId | None = Field(
        default=None, description="Null takes the only vehicle; with several it must be given"
    )
    target_energy_wh: Annotated[float, Field(gt=0, le=200_000, allow_inf_nan=False)] | None = Field(
        default=None, description="Charge: stop after this much energy; null: until full"
    )
    not_before: ScheduledTime | None = Field(
        default=None, description="Begin then; null: as soon as the robot is free"
    )
    unplug_by: ScheduledTime | None = Field(
        default=None, description="Charge: stop in time to be unplugged then, however full"
    )

    @model_validator(mode="after")
    def _limits_are_for_charging(self) -> Self:
        if self.type is not JobType.CHARGE:
            if self.target_energy_wh is not None:
                raise ValueError("target_energy_wh is for charge jobs only")
            if self.unplug_by is not None:
                raise ValueError("unplug_by is for charge jobs only")
        return self


class NeedsPerson(Wire):
    """Why a job does not go on by itself, and what a person may choose."""

    code: str = Field(examples=["robot_fault"])
    sentence: str = Field(description="In words: what was seen, and what to do first")
    choices: list[PersonChoice] = Field(
        description="resume: POST /jobs/{id}/resume; cancel: POST /jobs/{id}/cancel"
    )


class JobResult(Wire):
    """What a job measured; null where it did not get that far."""

    insertion_depth_mm: float | None = Field(
        default=None, description="Plug in the socket, from the rho3 encoder and the measured face"
    )
    lateral_error_mm: float | None = Field(
        default=None,
        description="Distance of the plug's axis from the measured socket axis at the entry",
    )
    lateral_sigma_mm: float | None = Field(
        default=None, description="Standard deviation of that measurement"
    )
    max_force_n: float | None = Field(default=None, description="Largest insertion force")
    energy_wh: float | None = Field(default=None, description="Energy charged")
    cost: float | None = Field(
        default=None, description="Of that energy, in the currency; null without a tariff"
    )
    currency: str | None = Field(default=None, description="ISO 4217, of the cost")
    cost_at: Timestamp | None = Field(default=None, description="Up to when the cost is counted")
    plugged_after_s: float | None = Field(
        default=None, description="From acceptance of the job to the plug seated"
    )
    limit_duration_s: float | None = Field(
        default=None, description="The same motion if only the joint limits mattered"
    )


class RecordingInfo(Wire):
    """What was recorded of a job: GET /api/v1/jobs/{id}/recording."""

    size_bytes: int = Field(ge=0)


class PlaybackMark(Wire):
    """Something that happens in a playback."""

    at_s: float = Field(ge=0, description="Seconds since the playback began")
    kind: Literal["phase", "divergence"]
    text: str = Field(description="Name of the phase, or what has parted")


class Playback(Wire):
    """How a recording plays back in 3D: GET /twin/?playbackPath=...playback.viser."""

    duration_s: float = Field(ge=0, description="Waits without motion are cut down")
    marks: list[PlaybackMark]


class Job(Wire):
    """One job, running or ended."""

    id: str = Field(description="Sortable by time (UUID version 7)")
    type: JobType
    state: JobState
    phase: JobPhase
    vehicle_id: VehicleId
    target_energy_wh: float | None
    not_before: Timestamp | None = None
    unplug_by: Timestamp | None = None
    created_at: Timestamp
    updated_at: Timestamp
    phase_started_at: Timestamp
    cancel_requested: bool
    paused: bool = Field(
        default=False, description="It waits for POST /jobs/{id}/resume; nothing moves or charges"
    )
    needs_person: NeedsPerson | None = Field(
        default=None, description="Running, but it waits until a person has decided"
    )
    result: JobResult
    error: Problem | None
    recording: RecordingInfo | None = Field(
        default=None, description="Null while the job runs, and where nothing is kept"
    )


class JobPage(Wire):
    """Jobs, newest first."""

    items: list[Job]
    next_cursor: str | None = Field(description="Pass as ?cursor= for the next page; null: end")


class JobEvent(Wire):
    """One entry of a job's journal."""

    sequence: int = Field(ge=1)
    at: Timestamp
    kind: str = Field(examples=["phase_started"])
    phase: JobPhase
    message: str = Field(description="In words")
    data: dict[str, Any] = Field(default_factory=dict)


class JobEvents(Wire):
    """The journal of one job, oldest first."""

    items: list[JobEvent]
    next_cursor: str | None = Field(
        default=None, description="Pass as ?cursor= for the next page; null: end"
    )
