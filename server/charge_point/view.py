"""What an energy manager sees: which state the charger is in."""

from __future__ import annotations

from drivers.station import PilotState, StationSnapshot
from server.control.model import PlugState, RobotMode
from server.jobs.model import JobPhase, JobType
from server.schema.charge_point import RestReason, RobotActivity
from server.schema.jobs import Job

LOADED = {PilotState.C, PilotState.D}
BROKEN = {RobotMode.FAULT, RobotMode.EMERGENCY_STOP, RobotMode.OFFLINE}
STANDS = {RobotMode.STOPPED, RobotMode.STOPPING}
WAY_OUT = {JobPhase.RELEASING, JobPhase.WITHDRAWING, JobPhase.PARKING}


def cp_state(
    *,
    mode: RobotMode,
    plug: PlugState,
    snapshot: StationSnapshot | None,
    resting: RestReason | None,
    job: Job | None,
) -> PilotState:
    """The control pilot state that the charger reports.

    A parked car counts as connected (B) although the plug is still in its parking place: energy
    managers never enable a charger without a car.

    Args:
        mode: Of the robot.
        plug: Where it is.
        snapshot: Newest reading of the station; None while it does not answer.
        resting: Why nothing is to be plugged in, if so.
        job: The running job.
    """
    if snapshot is None:
        return PilotState.E
    if snapshot.pilot in LOADED | {PilotState.E, PilotState.F}:
        return snapshot.pilot
    if mode in BROKEN or (job is not None and job.needs_person is not None):
        return PilotState.F
    if plug is PlugState.UNKNOWN and job is None:
        return PilotState.F
    if resting is not None:
        return PilotState.A
    if plug is not PlugState.INSERTED and mode in STANDS:
        return PilotState.A  # somebody at the robot has stopped it: nothing can be plugged in
    return PilotState.B


def activity(
    *, mode: RobotMode, plug: PlugState, snapshot: StationSnapshot | None, job: Job | None
) -> RobotActivity:
    """What the robot does, in one word."""
    if mode in BROKEN:
        return "fault"
    if job is not None and job.needs_person is not None:
        return "fault"
    if job is not None and job.paused:
        return "paused"
    if mode in STANDS:
        return "stopped"
    if job is not None and (job.type is JobType.UNPLUG or job.phase in WAY_OUT):
        return "unplugging"
    if plug is PlugState.INSERTED:
        loaded = snapshot is not None and snapshot.pilot in LOADED
        return "charging" if loaded else "plugged"
    if plug is PlugState.UNKNOWN:
        return "fault" if job is None else "plugging"
    return "parked" if job is None else "plugging"
