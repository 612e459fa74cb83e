"""Messages on the WebSocket /api/v1/ws, typed and versioned like the REST models.

The server sends one snapshot, then deltas that carry only the sections that changed, newest
value only. A client that falls behind gets the newest sections in its next delta, never a
backlog. Values older than ``stale_after_s`` should be shown as stale.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire
from server.schema.control import Control
from server.schema.divergence import TwinReport
from server.schema.guidance import Guidance
from server.schema.jobs import Job
from server.schema.outlook import Outlook
from server.schema.problem import Problem
from server.schema.robot import JogStep, Robot
from server.schema.routines import CalibrationNow
from server.schema.station import Station

PROTOCOL_VERSION: Literal[1] = 1


class Service(Wire):
    """The server itself."""

    version: str
    simulated: bool = Field(description="No real robot moves")
    simulated_parts: list[Literal["robot", "camera", "station"]] = Field(
        description="What is simulated; around a real robot the other parts follow its telemetry"
    )
    speed: float = Field(description="Simulated seconds per second; 1 for a real robot")
    camera_online: bool
    started_at: Timestamp
    storage: Problem | None = Field(
        default=None,
        description="Why nothing can be kept for now; the robot can still be unplugged",
    )


class Queue(Wire):
    """What comes after the job under way."""

    waiting: Job | None = Field(
        default=None,
        description="The job that has not begun; while nothing else runs, `job` may be the same",
    )


class Live(Wire):
    """Every live section."""

    robot: Robot
    job: Job | None = Field(description="The running job, else the newest one, else null")
    station: Station
    service: Service
    twin: TwinReport = TwinReport()
    guidance: Guidance | None = None
    queue: Queue = Queue()
    calibration: CalibrationNow = CalibrationNow()
    control: Control = Control()
    outlook: Outlook | None = Field(default=None, description="Null: nothing can be told")


class LiveChanges(Wire):
    """The sections that changed; absent ones did not, and null says that there is none any more."""

    robot: Robot | None = None
    job: Job | None = None
    station: Station | None = None
    service: Service | None = None
    twin: TwinReport | None = None
    guidance: Guidance | None = None
    queue: Queue | None = None
    calibration: CalibrationNow | None = None
    control: Control | None = None
    outlook: Outlook | None = None


class SnapshotMessage(Wire):
    """First message on every connection."""

    type: Literal["snapshot"] = "snapshot"
    version: Literal[1] = PROTOCOL_VERSION
    sequence: int
    stale_after_s: float = 1.0
    sent_s: float | None = Field(
        default=None,
        description="Seconds of a clock that never jumps, of any beginning: whoever receives "
        "messages ever later sees the past",
    )
    live: Live


class DeltaMessage(Wire):
    """Sections that changed since the last message on this connection."""

    type: Literal["delta"] = "delta"
    sequence: int
    sent_s: float | None = Field(
        default=None,
        description="Seconds of a clock that never jumps, of any beginning: whoever receives "
        "messages ever later sees the past",
    )
    changes: LiveChanges


class ReplyMessage(Wire):
    """Answer to a client message that carried an id."""

    type: Literal["reply"] = "reply"
    id: int
    ok: bool
    problem: Problem | None = None


ServerMessage = Annotated[
    SnapshotMessage | DeltaMessage | ReplyMessage, Field(discriminator="type")
]


class StopMessage(Wire):
    """Protective stop (category 2). Needs no control, is never queued."""

    type: Literal["stop"] = "stop"
    id: int | None = None


class EmergencyStopMessage(Wire):
    """Emergency stop (category 1, latched). Needs no control, is never queued."""

    type: Literal["emergency_stop"] = "emergency_stop"
    id: int | None = None


class JogMessage(Wire):
    """Hold-to-move: send it every 100 ms while the button is held.

    250 ms without one, ``jog_end``, or a closed connection stops the motion.
    """

    type: Literal["jog"] = "jog"
    id: int | None = None
    axis: Annotated[
        Literal["rho1", "rho2", "rho3", "x", "y", "insertion"], Field(description="As JogStep")
    ]
    direction: Literal[-1, 1]
    speed_mm_s: Annotated[float, Field(ge=0.5, le=20, allow_inf_nan=False)] = 10.0


class JogStepMessage(Wire):
    """One step, as POST /robot/jog."""

    type: Literal["jog_step"] = "jog_step"
    id: int | None = None
    step: JogStep


class MoveToMessage(Wire):
    """Hold to follow the way to a target: send it every 100 ms while the button is held.

    250 ms without one, ``jog_end``, or a closed connection stops the motion.
    """

    type: Literal["move_to"] = "move_to"
    id: int | None = None
    target_id: Annotated[str, Field(min_length=1, max_length=64)]


class JogEndMessage(Wire):
    """The button was released."""

    type: Literal["jog_end"] = "jog_end"
    id: int | None = None


class ResyncMessage(Wire):
    """Ask for a new snapshot."""

    type: Literal["resync"] = "resync"
    id: int | None = None


ClientMessage = Annotated[
    StopMessage
    | EmergencyStopMessage
    | JogMessage
    | JogStepMessage
    | MoveToMessage
    | JogEndMessage
    | ResyncMessage,
    Field(discriminator="type"),
]
