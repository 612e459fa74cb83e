"""Jobs as the API shows them."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from server.jobs.model import JobPhase, JobState, JobType
from server.schema.base import Timestamp, VehicleId, Wire
from server.schema.problem import Problem


class JobRequest(Wire):
    """A job to be done."""

    type: JobType
    vehicle_id: VehicleId | None = Field(
        default=None, description="Null takes the only vehicle; with several it must be given"
    )
    target_energy_wh: Annotated[float, Field(gt=0, le=200_000, allow_inf_nan=False)] | None = Field(
        default=None, description="Charge: stop after this much energy; null: until full"
    )

    @model_validator(mode="after")
    def _energy_is_for_charging(self) -> Self:
        if self.target_energy_wh is not None and self.type is not JobType.CHARGE:
            raise ValueError("target_energy_wh is for charge jobs only")
        return self


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
    created_at: Timestamp
    updated_at: Timestamp
    phase_started_at: Timestamp
    cancel_requested: bool
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
