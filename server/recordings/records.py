"""From what goes on in the server to the messages of a recording."""

from __future__ import annotations

import base64
import json
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from drivers.robot import RobotState
from drivers.station import StationSnapshot
from server.config.settings import Settings
from server.jpeg import as_jpeg
from server.localisation.socket_pose import SocketPose
from server.recordings.topics import (
    EventRecord,
    HeaderRecord,
    InsertionRecord,
    JointsRecord,
    PictureRecord,
    PlanRecord,
    PointRecord,
    RobotRecord,
    SocketRecord,
    StampRecord,
    StationRecord,
)
from server.schema.jobs import Job, JobEvent
from server.version import VERSION
from twin.divergence.insertion_force import InsertionForce
from twin.divergence.samples import Entry
from twin.geometry import RobotGeometry
from twin.kinematics import KinematicsError, gamma
from twin.motion import MotionPlan
from twin.scene.planned_path import planned_path

JPEG_QUALITY = 80
FRAME_ID = "camera"

_CONFIG = {
    "geometry",
    "loads",
    "actuators",
    "sag",
    "motion",
    "camera",
    "insertion",
    "park",
    "divergence",
}
"""What explains a recording. The rest of the configuration may hold secrets."""


def header_record(settings: Settings, job: Job, robot: str, began_at: datetime) -> HeaderRecord:
    """The first message of a recording."""
    return HeaderRecord(
        plugpilot_version=VERSION,
        job_id=job.id,
        job_type=job.type.value,
        vehicle_id=job.vehicle_id,
        robot=robot,
        simulated=settings.simulated,
        began_at=began_at.isoformat(),
        config_json=settings.model_dump_json(include=_CONFIG),
    )


def robot_record(state: RobotState, mode: str, plug: str, geometry: RobotGeometry) -> RobotRecord:
    """One telemetry sample."""
    return RobotRecord(
        board=state.board.value,
        mode=mode,
        plug=plug,
        measured_mm=_joints(state.measured.position),
        commanded_mm=_joints(state.commanded.position),
        measured_mm_s=_joints(state.measured.velocity),
        commanded_mm_s=_joints(state.commanded.velocity),
        tip=_tip(state, geometry),
        force_n=round(state.force_n, 3),
        homed=state.homed,
        enabled=state.enabled,
        fault=state.fault.code.value if state.fault else None,
    )


def plan_record(plan: MotionPlan | None, geometry: RobotGeometry) -> PlanRecord:
    """The way of a plan; an empty one when there is none."""
    path = None if plan is None else planned_path(geometry, plan)
    if path is None:
        return PlanRecord(times_s=[], tips=[])
    return PlanRecord(
        times_s=[round(time_s, 4) for time_s in path.times_s.tolist()],
        tips=[
            PointRecord(x_mm=round(x_mm, 2), y_mm=round(y_mm, 2), z_mm=round(z_mm, 2))
            for x_mm, y_mm, z_mm in path.tips_mm.tolist()
        ],
    )


def insertion_record(
    state: RobotState, entry: Entry, force: InsertionForce
) -> InsertionRecord | None:
    """Force over depth, or None while the slide stands or the plug is not at the socket."""
    depth_mm = state.measured.position.rho3_mm - entry.face_rho3_mm
    speed_mm_s = state.commanded.velocity.rho3_mm_s
    residual = force.judge(depth_mm, speed_mm_s, state.force_n, entry.sigma_mm)
    if residual is None:
        return None
    return InsertionRecord(
        depth_mm=round(depth_mm, 4),
        force_n=round(state.force_n, 3),
        expected_n=round(residual.expected, 3),
        low_n=round(residual.expected - 2 * residual.sigma, 3),
        high_n=round(residual.expected + 2 * residual.sigma, 3),
    )


def event_record(event: JobEvent) -> EventRecord:
    """One entry of the journal."""
    return EventRecord(
        sequence=event.sequence,
        kind=event.kind,
        phase=event.phase.value,
        message=event.message,
        data_json=json.dumps(event.data, default=str),
    )


def socket_record(socket: SocketPose) -> SocketRecord:
    """A measured pose of the socket."""
    return SocketRecord(
        T_base_socket=socket.T_base_socket.ravel().tolist(),
        T_base_label=socket.T_base_label.ravel().tolist(),
        covariance_mm2=socket.covariance.ravel().tolist(),
        lateral_sigma_mm=socket.lateral_sigma_mm,
        depth_sigma_mm=socket.depth_sigma_mm,
    )


def station_record(snapshot: StationSnapshot | None, *, online: bool) -> StationRecord:
    """One reading of the station."""
    return StationRecord(
        online=online,
        pilot=snapshot.pilot.value if snapshot else None,
        enabled=snapshot.enabled if snapshot else False,
        held=snapshot.held if snapshot else False,
        contactor_closed=snapshot.contactor_closed if snapshot else False,
        connector_locked=snapshot.connector_locked if snapshot else None,
        power_w=snapshot.power_w if snapshot else 0.0,
        currents_a=list(snapshot.currents_a) if snapshot else [],
        session_energy_wh=snapshot.session_energy_wh if snapshot else 0.0,
    )


def picture_record(image: NDArray[np.uint8], exposed_at_ns: int) -> PictureRecord:
    """A picture as JPEG at full size."""
    sec, nsec = divmod(exposed_at_ns, 1_000_000_000)
    return PictureRecord(
        timestamp=StampRecord(sec=sec, nsec=nsec),
        frame_id=FRAME_ID,
        data=base64.b64encode(as_jpeg(image, quality=JPEG_QUALITY)).decode(),
    )


def _joints(values: tuple[float, float, float]) -> JointsRecord:
    rho1, rho2, rho3 = (round(value, 4) for value in values)
    return JointsRecord(rho1=rho1, rho2=rho2, rho3=rho3)


def _tip(state: RobotState, geometry: RobotGeometry) -> PointRecord | None:
    if not state.homed:
        return None
    try:
        x_mm, y_mm, z_mm = gamma.forward(geometry, state.measured.position)
    except KinematicsError:
        return None
    return PointRecord(x_mm=round(x_mm, 3), y_mm=round(y_mm, 3), z_mm=round(z_mm, 3))
