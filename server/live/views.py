"""From the server's own state to the wire models that everyone sees."""

from __future__ import annotations

from drivers.robot import RobotDriverError, RobotState
from drivers.station import StationSnapshot
from server.control.faults import words_for
from server.control.stop_cause import StopCause
from server.control.supervisor import Supervisor
from server.control.trouble import words_for_trouble
from server.localisation.socket_pose import SocketPose
from server.schema.robot import (
    CommandedMotion,
    ControlHolder,
    Joints,
    MeasuredMotion,
    Robot,
    RobotFault,
    SocketEstimate,
    Tip,
)
from server.schema.station import Station
from server.timing import Calendar
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import KinematicsError, gamma


def robot_view(supervisor: Supervisor, socket: SocketPose | None, calendar: Calendar) -> Robot:
    """The robot now."""
    state = supervisor.telemetry.latest
    holder = supervisor.holder
    geometry = supervisor.geometry
    return Robot(
        mode=supervisor.mode,
        driver=supervisor.name,
        plug=supervisor.plug.state,
        enabled=state is not None and state.enabled,
        homed=state is not None and state.homed,
        measured=_measured(state, geometry) if state else None,
        commanded=_commanded(state, geometry) if state else None,
        control=ControlHolder(kind=holder.kind, name=holder.name, since=holder.since)
        if holder
        else None,
        fault=_fault(state) or _stop(supervisor.stop_cause)
        if state
        else _no_link(supervisor.link_trouble),
        socket=_socket(socket, calendar) if socket else None,
        updated_at=calendar.at(state.sampled_at_s) if state else calendar.now(),
    )


def station_view(
    name: str, snapshot: StationSnapshot | None, *, online: bool, calendar: Calendar
) -> Station:
    """The station as last read."""
    return Station(
        name=name,
        online=online,
        pilot=snapshot.pilot.value if snapshot else None,
        enabled=snapshot.enabled if snapshot else False,
        held=snapshot.held if snapshot else False,
        contactor_closed=snapshot.contactor_closed if snapshot else False,
        connector_locked=snapshot.connector_locked if snapshot else None,
        power_w=round(snapshot.power_w, 1) if snapshot else 0.0,
        currents_a=_rounded(snapshot.currents_a) if snapshot else (0.0, 0.0, 0.0),
        session_energy_wh=round(snapshot.session_energy_wh, 2) if snapshot else 0.0,
        updated_at=calendar.at(snapshot.sampled_at_s) if snapshot else None,
    )


def _rounded(currents_a: tuple[float, float, float]) -> tuple[float, float, float]:
    first, second, third = currents_a
    return round(first, 2), round(second, 2), round(third, 2)


def _measured(state: RobotState, geometry: RobotGeometry) -> MeasuredMotion:
    position = state.measured.position
    return MeasuredMotion(
        joints=_joints(position),
        tip=_tip(geometry, position) if state.homed else None,
        force_n=round(state.force_n, 1),
    )


def _commanded(state: RobotState, geometry: RobotGeometry) -> CommandedMotion:
    position = state.commanded.position
    return CommandedMotion(
        joints=_joints(position), tip=_tip(geometry, position) if state.homed else None
    )


def _joints(position: JointPosition) -> Joints:
    """Rounded to a micrometre: finer than a step, and short on the wire."""
    return Joints(
        rho1_mm=round(position.rho1_mm, 3),
        rho2_mm=round(position.rho2_mm, 3),
        rho3_mm=round(position.rho3_mm, 3),
    )


def _tip(geometry: RobotGeometry, position: JointPosition) -> Tip | None:
    try:
        tip = gamma.forward(geometry, position)
    except KinematicsError:
        return None  # no posture has these joints, which a damaged robot may well report
    return Tip(x_mm=round(tip.x_mm, 3), y_mm=round(tip.y_mm, 3), z_mm=round(tip.z_mm, 3))


def _no_link(trouble: RobotDriverError | None) -> RobotFault | None:
    if trouble is None:
        return None
    words = words_for_trouble(trouble)
    return RobotFault(code=words.code, title=words.title, detail=str(trouble), remedy=words.remedy)


def _fault(state: RobotState) -> RobotFault | None:
    if state.fault is None:
        return None
    words = words_for(state.fault)
    return RobotFault(
        code=state.fault.code.value,
        title=words.title,
        detail=state.fault.detail,
        remedy=words.remedy,
    )


def _stop(cause: StopCause | None) -> RobotFault | None:
    """A protective stop that no person pressed; who pressed one knows why."""
    if cause is None or cause.by_person:
        return None
    return RobotFault(
        code=cause.error.code,
        title=cause.error.title,
        detail=cause.words,
        remedy=cause.error.remedy,
    )


def _socket(socket: SocketPose, calendar: Calendar) -> SocketEstimate:
    entry = socket.entry
    x, y, z = (round(float(c), 6) for c in socket.axis)
    return SocketEstimate(
        entry=Tip(x_mm=round(entry.x_mm, 3), y_mm=round(entry.y_mm, 3), z_mm=round(entry.z_mm, 3)),
        axis=(x, y, z),
        lateral_sigma_mm=round(socket.lateral_sigma_mm, 4),
        depth_sigma_mm=round(socket.depth_sigma_mm, 4),
        measured_at=calendar.at(socket.measured_at_s),
    )
