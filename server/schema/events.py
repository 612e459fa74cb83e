"""Events: what happens, as webhooks and the event stream tell it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.control.model import PlugState
from server.schema.base import Timestamp, Wire
from server.schema.divergence import DivergenceReport
from server.schema.jobs import Job
from server.schema.robot import RobotFault


class JobHappened(Wire):
    """Data of job events."""

    job: Job


class PlugMoved(Wire):
    """Data of plug.changed."""

    plug: PlugState
    before: PlugState | None = Field(description="Null right after the start of PlugPilot")


class FaultBegan(Wire):
    """Data of robot.fault."""

    fault: RobotFault


class PersonNeeded(Wire):
    """Data of robot.needs_person."""

    needed: bool = Field(description="False: the robot can go on by itself again")
    reason: RobotFault | None = Field(description="Null when nobody is needed any more")


class DivergenceChanged(Wire):
    """Data of twin.divergence."""

    began: bool = Field(description="False: robot and model agree again")
    divergence: DivergenceReport


class Ping(Wire):
    """Data of ping."""

    message: str


class _Event(Wire):
    id: str = Field(
        description="The same in every attempt and every stream; sortable by time (UUID version 7)",
        examples=["01957a3c-7d50-7c44-8e0f-5b3c9d5a1f00"],
    )
    timestamp: Timestamp


class JobCreated(_Event):
    """A job was accepted."""

    type: Literal["job.created"] = "job.created"
    data: JobHappened


class JobPhaseBegan(_Event):
    """A job has entered a phase."""

    type: Literal["job.phase"] = "job.phase"
    data: JobHappened


class JobStateChanged(_Event):
    """A job was paused or resumed, or waits for a person, or no longer does."""

    type: Literal["job.state"] = "job.state"
    data: JobHappened


class JobEnded(_Event):
    """A job has ended; its state says how, its error why."""

    type: Literal["job.ended"] = "job.ended"
    data: JobHappened


class PlugChanged(_Event):
    """The plug is somewhere else."""

    type: Literal["plug.changed"] = "plug.changed"
    data: PlugMoved


class RobotFaultEvent(_Event):
    """The motion board reports a fault, or does not answer."""

    type: Literal["robot.fault"] = "robot.fault"
    data: FaultBegan


class NeedsPersonEvent(_Event):
    """The robot cannot go on without a person, or can again."""

    type: Literal["robot.needs_person"] = "robot.needs_person"
    data: PersonNeeded


class DivergenceEvent(_Event):
    """The robot and the model beside it have parted, or agree again."""

    type: Literal["twin.divergence"] = "twin.divergence"
    data: DivergenceChanged


class PingEvent(_Event):
    """Somebody tries out a webhook."""

    type: Literal["ping"] = "ping"
    data: Ping


Happening = (
    JobCreated
    | JobPhaseBegan
    | JobStateChanged
    | JobEnded
    | PlugChanged
    | RobotFaultEvent
    | NeedsPersonEvent
    | DivergenceEvent
)
"""What happens by itself."""

Event = Annotated[Happening | PingEvent, Field(discriminator="type")]

EventType = Literal[
    "job.created",
    "job.phase",
    "job.state",
    "job.ended",
    "plug.changed",
    "robot.fault",
    "robot.needs_person",
    "twin.divergence",
]
"""What can be subscribed to; a ping comes only when it is asked for."""
