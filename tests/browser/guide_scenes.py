"""One state for each guide that leads a person step by step."""

from __future__ import annotations

from server.control.model import PlugState
from server.jobs.model import JobPhase, PersonChoice
from server.schema.jobs import NeedsPerson
from server.schema.live import Live
from tests.browser.scenes import SCENES as STATES
from tests.browser.scenes import job, live, robot

CODES = (
    "label_not_found",
    "pose_uncertain",
    "place_implausible",
    "socket_unreachable",
    "actuator_overload",
    "insertion_jammed",
    "plug_missed",
    "car_gone",
    "connector_locked",
    "under_load",
    "station_unsafe",
    "no_contact",
    "robot_offline",
    "heartbeat_lost",
    "following_error",
    "watchdog",
    "wrong_firmware",
    "camera_down",
    "long_outage",
    "of_a_newer_server",
)


def _asking(code: str) -> Live:
    choices = [PersonChoice.RESUME, PersonChoice.CANCEL]
    needs = NeedsPerson(code=code, sentence="Somebody has to look.", choices=choices)
    waiting = job(JobPhase.INSERTING).model_copy(update={"needs_person": needs})
    return live(robot(plug=PlugState.FREE), waiting)


SCENES = {name: STATES[name] for name in ("stopped", "unknown", "emergency")} | {
    code: _asking(code) for code in CODES
}
"""Those without a job first: the live connection never takes a job away again."""
