"""What a recording holds: one model for each topic, units in the names.

Messages are JSON; the JSON schema of each model is in the file, so that Foxglove and every other
reader of MCAP knows them without this project.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from server.schema.divergence import DivergenceReport


class Record(BaseModel):
    """One message."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="null")


class JointsRecord(Record):
    """One number for each joint."""

    rho1: float
    rho2: float
    rho3: float


class PointRecord(Record):
    """A point of the base frame: x along the rail, y up, z towards the car [mm]."""

    x_mm: float
    y_mm: float
    z_mm: float


class RobotRecord(Record):
    """One telemetry sample."""

    board: str
    mode: str
    plug: str
    measured_mm: JointsRecord = Field(description="Step counters of rho1, rho2; encoder of rho3")
    commanded_mm: JointsRecord = Field(description="Set point at the same instant")
    measured_mm_s: JointsRecord
    commanded_mm_s: JointsRecord
    tip: PointRecord | None = Field(description="Measured plug tip; null before homing")
    force_n: float = Field(description="Along the insertion axis, positive towards the car")
    homed: bool
    enabled: bool
    fault: str | None


class PlanRecord(Record):
    """The way of the plug's tip for the plan that is followed from now on."""

    times_s: list[float] = Field(
        description="After the plan's start, ascending; empty: no plan is followed"
    )
    tips: list[PointRecord] = Field(description="Planned tip at these times")


class InsertionRecord(Record):
    """Force over depth beside that of a good insertion; only while the slide moves."""

    depth_mm: float = Field(description="Plug tip behind the socket's face")
    force_n: float = Field(description="Measured")
    expected_n: float = Field(
        description="Of a good insertion; on the way out the strongest pull that is usual"
    )
    low_n: float = Field(description="Expected minus two standard deviations")
    high_n: float = Field(description="Expected plus two standard deviations")


class EventRecord(Record):
    """One entry of the job's journal."""

    sequence: int
    kind: str
    phase: str
    message: str
    data_json: str = Field(description="Facts by name with unit, as JSON")


class SocketRecord(Record):
    """A measured pose of the socket. Matrices row by row; translations in mm."""

    T_base_socket: list[float] = Field(min_length=16, max_length=16)
    T_base_label: list[float] = Field(min_length=16, max_length=16)
    covariance_mm2: list[float] = Field(
        min_length=9, max_length=9, description="Of the socket's origin in the base frame"
    )
    lateral_sigma_mm: float
    depth_sigma_mm: float


class StationRecord(Record):
    """One reading of the charging station."""

    online: bool
    pilot: str | None = Field(description="Control pilot state of IEC 61851")
    enabled: bool
    held: bool
    contactor_closed: bool
    connector_locked: bool | None
    power_w: float
    currents_a: list[float]
    session_energy_wh: float


class DivergenceRecord(Record):
    """Model and robot have parted, or agree again."""

    began: bool
    report: DivergenceReport
    largest_difference: float = Field(description="So far, in the report's unit")


class StampRecord(Record):
    """A time as Foxglove writes it."""

    sec: int
    nsec: int


class PictureRecord(Record):
    """The picture that a pose came from, in Foxglove's own form."""

    timestamp: StampRecord = Field(description="Middle of the exposure")
    frame_id: str
    data: str = Field(description="JPEG", json_schema_extra={"contentEncoding": "base64"})
    format: Literal["jpeg"] = "jpeg"


class HeaderRecord(Record):
    """What robot, what software, which job."""

    plugpilot_version: str
    job_id: str
    job_type: str
    vehicle_id: str
    robot: str = Field(description="Name of the motion board")
    simulated: bool
    began_at: str = Field(description="Date and time, ISO 8601")
    config_json: str = Field(
        description="Geometry, loads, sag, motion and force limits, camera, insertion and "
        "expectations, as JSON"
    )


class EndRecord(Record):
    """The recording was closed in order."""

    dropped: int = Field(description="Messages left out because the disk was too slow")
    pictures_left_out: int = Field(description="Poses whose picture was not kept")


@dataclass(frozen=True, slots=True)
class Topic:
    """A channel of the file.

    Attributes:
        name: Of the topic.
        schema_name: Of its schema.
        model: Of its messages.
    """

    name: str
    schema_name: str
    model: type[Record]

    @property
    def schema_json(self) -> bytes:
        """JSON schema of the messages, without references, which some readers cannot follow."""
        schema = self.model.model_json_schema()
        definitions = schema.pop("$defs", {})
        return json.dumps(_inlined(schema, definitions)).encode()


HEADER = Topic("/recording/header", "plugpilot.Header", HeaderRecord)
END = Topic("/recording/end", "plugpilot.End", EndRecord)
ROBOT = Topic("/robot/state", "plugpilot.RobotState", RobotRecord)
PLAN = Topic("/robot/plan", "plugpilot.Plan", PlanRecord)
INSERTION = Topic("/robot/insertion", "plugpilot.Insertion", InsertionRecord)
EVENT = Topic("/job/events", "plugpilot.JobEvent", EventRecord)
SOCKET = Topic("/socket/pose", "plugpilot.SocketPose", SocketRecord)
STATION = Topic("/station/state", "plugpilot.Station", StationRecord)
DIVERGENCE = Topic("/twin/divergence", "plugpilot.Divergence", DivergenceRecord)
PICTURE = Topic("/camera/key", "foxglove.CompressedImage", PictureRecord)

TOPICS = (HEADER, END, ROBOT, PLAN, INSERTION, EVENT, SOCKET, STATION, DIVERGENCE, PICTURE)


def _inlined(part: Any, definitions: Mapping[str, Any]) -> Any:  # noqa: ANN401 - any JSON
    if isinstance(part, list):
        return [_inlined(item, definitions) for item in part]
    if not isinstance(part, dict):
        return part
    reference = part.get("$ref")
    if reference is not None:
        target = definitions[reference.rpartition("/")[2]]
        rest = {key: value for key, value in part.items() if key != "$ref"}
        return _inlined({**target, **rest}, definitions)
    return {key: _inlined(value, definitions) for key, value in part.items()}
