"""When a job reaches its next milestone: a pure function of what is known now."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import NamedTuple

from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.errors import JobCancelledError
from server.jobs.model import JobPhase, JobState, JobType, Milestone
from server.jobs.outlook.phase_times import PhaseTimes, TimedPhase
from server.jobs.outlook.progress import Progress, Stage
from server.jobs.turning_back import Return, TurnBack, may_be_cancelled
from server.schema.jobs import Job
from server.schema.outlook import Outlook

WAY_IN = (JobPhase.PREFLIGHT, JobPhase.LOCATING, JobPhase.ALIGNING, JobPhase.INSERTING)
WAY_OUT = (JobPhase.RELEASING, JobPhase.WITHDRAWING, JobPhase.PARKING)
PULLED_OUT = (JobPhase.RELEASING, JobPhase.WITHDRAWING)
SEATED = (JobPhase.PLUGGED, JobPhase.CHARGING)


@dataclass(frozen=True, slots=True)
class Charge:
    """How far the charging has come.

    Attributes:
        left_wh: Energy until the job has its target; None without one.
        power_w: What the car charges with, evenly; None while it does not.
        unplug_lead: Charging ends so long before the car is to be unplugged.
    """

    left_wh: float | None
    power_w: float | None
    unplug_lead: timedelta


@dataclass(frozen=True, slots=True)
class Sight:
    """All that the outlook of a job follows from.

    Attributes:
        job: The newest job.
        progress: What its journal says.
        plug: Where the plug is.
        homed: The robot knows where it is.
        charge: How far the charging has come.
        now: The date.
        clock_speed: Seconds of the robot per second of the dates.
    """

    job: Job
    progress: Progress
    plug: PlugState
    homed: bool
    charge: Charge
    now: datetime
    clock_speed: float


class Course(NamedTuple):
    """What lies between now and the next milestone of a robot that moves.

    Attributes:
        milestone: Where it leads.
        stage: The phase under way; None when it is being broken off.
        to_come: The phases after it.
    """

    milestone: Milestone
    stage: Stage | None
    to_come: Sequence[JobPhase]


def outlook(seen: Sight, times: PhaseTimes) -> Outlook | None:
    """The next milestone of the job, or None when nothing can be told of it.

    Args:
        seen: What is known.
        times: How long phases take.
    """
    job = seen.job
    if job.state is not JobState.RUNNING or job.paused or job.needs_person is not None:
        return None
    course = _course(seen)
    if course is not None:
        return Outlook(
            milestone=course.milestone, at=_end_of_course(course, seen, times), latest=False
        )
    stage = seen.progress.stage
    charges = stage is not None and stage.phase in SEATED and job.type is JobType.CHARGE
    if not charges or seen.progress.charging_done or _turns_back(seen) is not None:
        return None
    return _end_of_charging(seen)


def _course(seen: Sight) -> Course | None:
    """None while nothing moves, or nobody knows how it goes on."""
    stage, turns = seen.progress.stage, _turns_back(seen)
    if turns is not None:
        way_back = _way_back(seen, turns)
        return Course(Milestone.UNPLUGGED, None, way_back) if way_back else None
    if stage is None or stage.phase in SEATED:
        return None
    if stage.phase is JobPhase.PREFLIGHT and seen.job.type is JobType.UNPLUG:
        return Course(Milestone.UNPLUGGED, stage, WAY_OUT)
    if stage.phase in WAY_IN:
        return Course(Milestone.PLUGGED, stage, _behind(stage, WAY_IN))
    if _goes_in_again(seen):
        return Course(Milestone.PLUGGED, stage, (*_behind(stage, PULLED_OUT), *WAY_IN))
    return Course(Milestone.UNPLUGGED, stage, _behind(stage, WAY_OUT))


def _turns_back(seen: Sight) -> Return | None:
    """How a job ends early whose way back has not begun yet; None for all others."""
    job, progress = seen.job, seen.progress
    if progress.turned is None and job.cancel_requested and may_be_cancelled(job):
        return TurnBack.because(job, JobCancelledError("Somebody cancelled the job.")).how
    return progress.turned if progress.stage is None else None


def _way_back(seen: Sight, how: Return) -> Sequence[JobPhase]:
    """The phases of a job that turns back; none when it stays where it is."""
    if how is not Return.COME_BACK or seen.plug is PlugState.PARKED:
        return ()
    return WAY_OUT if seen.plug in HELD else (JobPhase.PARKING,)


def _goes_in_again(seen: Sight) -> bool:
    """Interrupted in the insertion, a job pulls the plug out before it begins anew."""
    return (
        seen.job.type is not JobType.UNPLUG
        and seen.progress.turned is None
        and not seen.progress.charging_done
        and seen.progress.stage is not None
        and seen.progress.stage.phase in PULLED_OUT
    )


def _behind(stage: Stage, phases: Sequence[JobPhase]) -> Sequence[JobPhase]:
    return phases[phases.index(stage.phase) + 1 :]


def _end_of_course(course: Course, seen: Sight, times: PhaseTimes) -> datetime:
    """A phase that takes longer than usual may end any moment; what follows takes its time."""
    over = seen.now
    if course.stage is not None:
        usual = _usual(course.stage.phase, seen, times)
        over = max(over, course.stage.began_at + usual)
    return over + sum((_usual(phase, seen, times) for phase in course.to_come), timedelta())


def _usual(phase: JobPhase, seen: Sight, times: PhaseTimes) -> timedelta:
    """How long a phase takes, in seconds of the dates."""
    if phase is not JobPhase.PREFLIGHT or seen.job.type is JobType.UNPLUG:
        duration_s = times.usual_s(TimedPhase(phase))
    else:
        stage = seen.progress.stage
        # At the end of a homing the robot knows where it is, and the phase goes on.
        homing = not seen.homed or (stage is not None and stage.homing)
        duration_s = times.usual_s(TimedPhase(phase, homing))
        if not homing and seen.plug is not PlugState.PARKED:
            duration_s += times.usual_s(TimedPhase(JobPhase.PARKING))  # it goes there first
    return timedelta(seconds=duration_s / seen.clock_speed)


def _end_of_charging(seen: Sight) -> Outlook | None:
    """By the energy that is left, or by the clock, whichever comes first."""
    charge, unplug_by = seen.charge, seen.job.unplug_by
    ends: list[Outlook] = []
    if charge.left_wh is not None and charge.power_w is not None:
        left_s = max(0.0, charge.left_wh) / charge.power_w * 3600 / seen.clock_speed
        at = seen.now + timedelta(seconds=left_s)
        ends.append(Outlook(milestone=Milestone.CHARGED, at=at, latest=False))
    if unplug_by is not None:
        at = max(seen.now, unplug_by - charge.unplug_lead)
        ends.append(Outlook(milestone=Milestone.CHARGED, at=at, latest=True))
    return min(ends, key=lambda end: end.at, default=None)
