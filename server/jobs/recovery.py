"""How a job goes on after it was interrupted: the journal and what can be seen decide.

A pure function of evidence, so that every case can be looked at. Three things never happen: a
motion sideways while the plug may be in a socket, a way in begun with a plug whose place is not
known, and a guess.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from enum import StrEnum

from drivers.robot import BoardFault, FaultCode
from server.config.jobs import JobSettings
from server.control.faults import words_for
from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.errors import JobCancelledError, JobInterruptedError
from server.jobs.history import History
from server.jobs.interruptions import JobInterruption, PersonNeeded, TurnedBack
from server.jobs.model import JobPhase, JobType
from server.jobs.turning_back import TurnBack, may_be_cancelled
from server.schema.jobs import Job

OWN_SILENCE = {FaultCode.HEARTBEAT_LOST, FaultCode.QUEUE_UNDERRUN}
"""What a board latches because PlugPilot has died: the cause is known, and over."""

SEATED = {JobPhase.PLUGGED, JobPhase.CHARGING}
"""The plug was seated before these began."""

MOST_RESTARTS = 3
"""Times ``max_resumptions``, whatever the phase."""


class Way(StrEnum):
    """How a job goes on."""

    PLUG_IN = "plug_in"  # from the beginning: nothing is in a socket
    PULL_OUT_FIRST = (
        "pull_out_first"  # the plug may be half in: out with it, then from the beginning
    )
    STAY_IN = "stay_in"  # the plug is in, and nothing needs to move
    UNPLUG = "unplug"  # end the load, withdraw, park
    PARK = "park"  # the plug is free already
    NOTHING = "nothing"  # it is parked already


IN_WORDS = {
    Way.PLUG_IN: "The plug is free, so it begins anew.",
    Way.PULL_OUT_FIRST: "The plug may be half in, so it comes out before it goes in again.",
    Way.STAY_IN: "The plug is in, so nothing needs to move.",
    Way.UNPLUG: "The plug comes out now.",
    Way.PARK: "The plug is out, so the robot goes back to its parking place.",
    Way.NOTHING: "The robot is back in its parking place already.",
}

MOVES_OUTWARD = {Way.PLUG_IN, Way.PULL_OUT_FIRST}


@dataclass(frozen=True, slots=True)
class Evidence:
    """What is known when a job is taken up again.

    Attributes:
        job: As it was written down last.
        history: What its journal says.
        after_restart: PlugPilot has been restarted; otherwise a person resumes the job.
        outage: How long ago something was written down.
        plug: Where the plug is, by its record and by what the board says against it.
        fault: What the board has latched.
    """

    job: Job
    history: History
    after_restart: bool
    outage: timedelta
    plug: PlugState
    fault: BoardFault | None


def decide(seen: Evidence, limits: JobSettings) -> Way:
    """How the job goes on.

    Raises:
        TurnedBack: it does not go on, but back.
        PersonNeeded: nobody can tell without looking.
        JobInterruptedError: what it was doing has been ended by hand.
    """
    job = seen.job
    if seen.history.turn_back is not None:
        raise TurnedBack(seen.history.turn_back, written=True)
    if job.cancel_requested and may_be_cancelled(job):
        cancelled = JobCancelledError("Somebody cancelled the job.")
        raise TurnedBack(TurnBack.because(job, cancelled), written=False)
    if seen.after_restart and job.needs_person is not None:
        raise PersonNeeded(job.needs_person.code, job.needs_person.sentence)
    way = _way(seen)
    problem = _why_not_alone(seen, way, limits)
    if problem is not None:
        raise problem
    return way


def _way(seen: Evidence) -> Way:
    job, held = seen.job, seen.plug in HELD
    if job.type is JobType.UNPLUG or seen.history.charging_done:
        if held:
            return Way.UNPLUG
        return Way.NOTHING if seen.plug is PlugState.PARKED else Way.PARK
    if job.phase in SEATED:
        if not held:
            raise JobInterruptedError(
                f"In the phase {job.phase.value} the plug was in the car; now it is "
                f"{seen.plug.value}, so somebody else has pulled it out.",
                plug=seen.plug.value,
            )
        return Way.STAY_IN
    return Way.PULL_OUT_FIRST if held else Way.PLUG_IN


def _why_not_alone(seen: Evidence, way: Way, limits: JobSettings) -> JobInterruption | None:
    """What a person must see before the job goes on this way; None when nothing is open."""
    if way in {Way.NOTHING, Way.STAY_IN}:
        return None
    if seen.fault is not None and not _is_expected(seen.fault, way, after=seen.after_restart):
        words = words_for(seen.fault)
        return PersonNeeded(
            "robot_fault", f"{words.title}: {seen.fault.detail} {words.remedy} Then resume the job."
        )
    if not seen.after_restart:
        return None
    times = seen.history.resumptions
    phase = seen.job.phase
    most = limits.max_resumptions
    if times.get(phase, 0) >= most or sum(times.values()) >= MOST_RESTARTS * most:
        return PersonNeeded(
            "restarted_too_often",
            f"PlugPilot has been restarted {sum(times.values()) + 1} times during this job, now in "
            f"the phase {phase.value}. Look at the robot and at its power supply, then resume the "
            "job or cancel it.",
        )
    if way in MOVES_OUTWARD and seen.outage > timedelta(minutes=limits.max_outage_min):
        hours = seen.outage / timedelta(hours=1)
        return PersonNeeded(
            "long_outage",
            f"PlugPilot was off for {hours:.0f} hours during this job. See whether the car is "
            "still there and the way is clear, then resume the job or cancel it.",
        )
    return None


def _is_expected(fault: BoardFault, way: Way, *, after: bool) -> bool:
    """Whether the fault tells nothing that a person would have to look for."""
    if fault.code is FaultCode.STALL:
        # A plug that jams on its way in; the withdrawal releases it.
        return way in {Way.UNPLUG, Way.PULL_OUT_FIRST}
    return after and fault.code in OWN_SILENCE
