"""Named live states, each as the server would send it."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Literal

from server.control.model import PlugState, RobotMode
from server.jobs.model import JobPhase, JobState, JobType, Milestone, PersonChoice
from server.schema.divergence import DivergenceReport, TwinReport
from server.schema.jobs import Job, JobResult, NeedsPerson
from server.schema.live import Live, Queue, Service
from server.schema.outlook import Outlook
from server.schema.problem import Problem, problem_from
from server.schema.robot import (
    CommandedMotion,
    ControlHolder,
    Joints,
    MeasuredMotion,
    Robot,
    RobotFault,
    Tip,
)
from server.schema.station import Station
from server.storage.errors import DiskFullError
from tests.support.jobs import job_of
from twin.divergence import Quantity

Part = Literal["robot", "camera", "station"]

NOW = datetime(2026, 3, 1, 18, 4, 5, tzinfo=UTC)
_JOINTS = Joints(rho1_mm=203.2, rho2_mm=198.7, rho3_mm=92.4)
_TIP = Tip(x_mm=651.3, y_mm=341.8, z_mm=412.6)

LABEL_NOT_FOUND = Problem(
    type="urn:plugpilot:problem:label_not_found",
    title="Label not found",
    status=409,
    code="label_not_found",
    detail="The camera did not find the label of Renault Zoe within 20 s.",
    remedy="Park the car in front of the robot, clean the label, and try again.",
)


def robot(
    mode: RobotMode = RobotMode.READY,
    plug: PlugState = PlugState.PARKED,
    *,
    force_n: float = 0.4,
    fault: RobotFault | None = None,
    control: ControlHolder | None = None,
) -> Robot:
    """A robot in a state that goes together with its mode."""
    known = mode not in {RobotMode.OFFLINE, RobotMode.OFF, RobotMode.NOT_HOMED, RobotMode.HOMING}
    tip = _TIP if known else None
    online = mode is not RobotMode.OFFLINE
    return Robot(
        mode=mode,
        driver="Simulator",
        plug=plug,
        enabled=mode not in {RobotMode.OFFLINE, RobotMode.OFF, RobotMode.EMERGENCY_STOP},
        homed=known,
        measured=MeasuredMotion(joints=_JOINTS, tip=tip, force_n=force_n) if online else None,
        commanded=CommandedMotion(joints=_JOINTS, tip=tip) if online else None,
        control=control,
        fault=fault,
        socket=None,
        updated_at=NOW,
    )


def job(
    phase: JobPhase,
    job_type: JobType = JobType.CHARGE,
    state: JobState = JobState.RUNNING,
    *,
    seconds: float = 7,
    error: Problem | None = None,
    result: JobResult | None = None,
    cancel_requested: bool = False,
) -> Job:
    """A job that has been in its phase for some seconds."""
    return job_of(
        NOW,
        type=job_type,
        state=state,
        phase=phase,
        created_at=NOW - timedelta(seconds=seconds + 40),
        phase_started_at=NOW - timedelta(seconds=seconds),
        cancel_requested=cancel_requested,
        result=result or JobResult(),
        error=error,
    )


def station(power_w: float = 0, energy_wh: float = 0, *, online: bool = True) -> Station:
    """The charging station; it charges when there is power."""
    charging = power_w > 0
    return Station(
        name="Simulator",
        online=online,
        pilot="C" if charging else "A",
        enabled=charging,
        held=False,
        contactor_closed=charging,
        connector_locked=charging,
        power_w=power_w,
        currents_a=(power_w / 690,) * 3,
        session_energy_wh=energy_wh,
        updated_at=NOW,
    )


def live(
    robot_now: Robot,
    job_now: Job | None = None,
    station_now: Station | None = None,
    *,
    speed: float = 10,
    simulated: tuple[Part, ...] = ("robot", "camera", "station"),
) -> Live:
    """Every section together."""
    return Live(
        robot=robot_now,
        job=job_now,
        station=station_now or station(),
        service=Service(
            version="0.1.0",
            simulated="robot" in simulated,
            simulated_parts=list(simulated),
            speed=speed,
            camera_online=True,
            started_at=NOW,
        ),
    )


def _due(shown: Live, milestone: Milestone, seconds: float, *, latest: bool = False) -> Live:
    """The same with what can be foretold of its job."""
    at = NOW + timedelta(seconds=seconds)
    return shown.model_copy(update={"outlook": Outlook(milestone=milestone, at=at, latest=latest)})


def _paused(running: Job) -> Job:
    return running.model_copy(update={"paused": True})


def _asking(running: Job) -> Job:
    needs = NeedsPerson(
        code="insertion_jammed",
        sentence="The plug met 78 N when it was 12 mm deep, three times. Look whether something is "
        "in the socket.",
        choices=[PersonChoice.RESUME, PersonChoice.CANCEL],
    )
    return running.model_copy(update={"needs_person": needs})


def _planned(queued: Job) -> Job:
    begin = NOW + timedelta(hours=4)
    return queued.model_copy(update={"not_before": begin, "unplug_by": begin + timedelta(hours=9)})


def _with_next(shown: Live, job_type: JobType, **changes: object) -> Live:
    """The same with another job that waits."""
    waiting = job(JobPhase.PREFLIGHT, job_type, JobState.QUEUED)
    waiting = waiting.model_copy(update={"id": "01956b1e-8c00-7000-8000-000000000002", **changes})
    return shown.model_copy(update={"queue": Queue(waiting=waiting)})


def _unsaved(shown: Live) -> Live:
    problem = problem_from(DiskFullError("/data/plugpilot.sqlite3: database or disk is full."))
    service = shown.service.model_copy(update={"storage": problem})
    return shown.model_copy(update={"service": service})


_MOVING_AT_REST = robot(RobotMode.READY, PlugState.FREE)
_MOVING = robot(RobotMode.MOVING, PlugState.FREE)
_IN = robot(RobotMode.READY, PlugState.INSERTED)

_PARTED = TwinReport(
    divergences=[
        DivergenceReport(
            quantity=Quantity.RHO3,
            title="The slide does not follow",
            message="The slide is at 82.31 mm instead of 83.19 mm: 0.87 mm off, "
            "12 times its uncertainty.",
            unit="mm",
            expected=83.19,
            measured=82.31,
            sigma=0.073,
            sigmas=12.0,
            at=NOW,
            phase="inserting",
            joints=_JOINTS,
            depth_mm=12.3,
            tip_off_mm=0.87,
        )
    ]
)

SCENES: dict[str, Live] = {
    "ready": live(robot()),
    "off": live(robot(RobotMode.OFF)),
    "homing": live(robot(RobotMode.HOMING)),
    "locating": live(robot(), job(JobPhase.LOCATING)),
    "aligning": _due(live(_MOVING, job(JobPhase.ALIGNING)), Milestone.PLUGGED, 28),
    "inserting": _due(
        live(robot(RobotMode.MOVING, PlugState.INSERTED, force_n=38.2), job(JobPhase.INSERTING)),
        Milestone.PLUGGED,
        1,
    ),
    "parted": live(
        robot(RobotMode.MOVING, PlugState.INSERTED, force_n=79.1), job(JobPhase.INSERTING)
    ).model_copy(update={"twin": _PARTED}),
    "charging": _due(
        live(_IN, job(JobPhase.CHARGING, seconds=5025), station(10_980, 15_340)),
        Milestone.CHARGED,
        7800,
    ),
    "next": _with_next(
        live(_IN, job(JobPhase.CHARGING, seconds=5025), station(10_980, 15_340)),
        JobType.CHARGE,
        not_before=NOW + timedelta(hours=4),
        unplug_by=NOW + timedelta(hours=13),
    ),
    "disk_full": _unsaved(_with_next(live(_IN), JobType.UNPLUG, paused=True)),
    "charging_priced": _due(
        live(
            _IN,
            job(JobPhase.CHARGING, seconds=5025, result=JobResult(cost=14.37, currency="EUR")),
            station(10_980, 15_340),
        ),
        Milestone.CHARGED,
        46_740,
        latest=True,
    ),
    "withdrawing": _due(
        live(
            robot(RobotMode.MOVING, PlugState.INSERTED),
            job(JobPhase.WITHDRAWING, JobType.UNPLUG),
        ),
        Milestone.UNPLUGGED,
        28,
    ),
    "paused": live(_MOVING_AT_REST, _paused(job(JobPhase.ALIGNING))),
    "needs_person": live(robot(plug=PlugState.FREE), _asking(job(JobPhase.INSERTING))),
    "planned": live(robot(), _planned(job(JobPhase.PREFLIGHT, state=JobState.QUEUED))),
    "done": live(
        robot(),
        job(JobPhase.PARKING, state=JobState.SUCCEEDED, result=JobResult(energy_wh=21_480)),
    ),
    "plugged": live(_IN, job(JobPhase.PLUGGED, JobType.PLUG_IN, JobState.SUCCEEDED)),
    "failed": live(robot(), job(JobPhase.LOCATING, state=JobState.FAILED, error=LABEL_NOT_FOUND)),
    "unknown": live(robot(RobotMode.READY, PlugState.UNKNOWN)),
    "stopped": live(robot(RobotMode.STOPPED, PlugState.FREE)),
    "emergency": live(robot(RobotMode.EMERGENCY_STOP, PlugState.INSERTED)),
    "fault": live(
        robot(
            RobotMode.FAULT,
            PlugState.FREE,
            fault=RobotFault(
                code="following_error",
                title="The arm lost its way",
                detail="The left actuator was 4.2 mm behind its set point.",
                remedy="Look whether something blocks the arm, then release and find position.",
            ),
        )
    ),
    "no_board": live(
        robot(
            RobotMode.OFFLINE,
            PlugState.UNKNOWN,
            fault=RobotFault(
                code="board_not_found",
                title="No motion board at its port",
                detail="The port /dev/serial/by-id/usb-1a86_USB2.0-Serial-if00-port0 cannot be "
                "opened: No such file or directory.",
                remedy="Check that the board has power, and that its USB cable is in at both ends.",
            ),
        ),
        speed=1,
        simulated=("camera", "station"),
    ),
    "offline": live(robot(RobotMode.OFFLINE, PlugState.UNKNOWN)),
    "jog": live(
        robot(
            RobotMode.MOVING,
            PlugState.FREE,
            control=ControlHolder(kind="jog", name="Anna", since=NOW),
        )
    ),
}
