"""Whether the robot cannot go on without a person, and why."""

from __future__ import annotations

from server.control.model import PlugState, RobotMode
from server.jobs.model import JobState
from server.schema.jobs import Job
from server.schema.robot import Robot, RobotFault

ASKS = "The robot needs a decision"
PLUG_UNKNOWN = RobotFault(
    code="plug_unknown",
    title="PlugPilot does not know where the plug is",
    detail="The plug may be in the car, so the robot does not move.",
    remedy="Look at the robot. Unplug on the page, or confirm there that the plug is out.",
)


def why_person_needed(robot: Robot, job: Job | None) -> RobotFault | None:
    """The reason in words, or None when the robot can go on by itself.

    Args:
        robot: As everyone sees it.
        job: The newest one.
    """
    if robot.fault is not None and robot.mode is not RobotMode.STOPPED:
        return robot.fault
    if robot.plug is PlugState.UNKNOWN:
        return PLUG_UNKNOWN
    if job is None:
        return None
    if job.needs_person is not None:
        needs = job.needs_person
        return RobotFault(
            code=needs.code, title=ASKS, detail=needs.sentence, remedy="Resume or cancel the job."
        )
    if job.state is JobState.FAILED and job.error and robot.plug is PlugState.INSERTED:
        error = job.error
        return RobotFault(
            code=error.code, title=error.title, detail=error.detail, remedy=error.remedy
        )
    return None
