"""Control in all its states, as Anna sees them who owns the robot."""

from __future__ import annotations

from datetime import timedelta

from server.access.rights import Role
from server.control.model import PlugState, RobotMode
from server.schema.control import (
    Control,
    ControlAnswer,
    ControlPerson,
    ControlRequest,
    ControlSeat,
)
from tests.browser.scenes import NOW, live, robot

ANNA = ControlPerson(id="anna", name="Anna", role=Role.OWNER)
BEN = ControlPerson(id="ben", name="Ben", role=Role.TECHNICIAN)


def _seat(person: ControlPerson) -> ControlSeat:
    return ControlSeat(person=person, since=NOW, ends_at=NOW + timedelta(seconds=60))


def _request(person: ControlPerson) -> ControlRequest:
    ends_at = NOW + timedelta(seconds=28)
    return ControlRequest(id="request", person=person, asked_at=NOW, ends_at=ends_at)


_CONTROLS = {
    "held": Control(holder=_seat(BEN)),
    "mine": Control(holder=_seat(ANNA)),
    "asked": Control(holder=_seat(ANNA), request=_request(BEN)),
    "asking": Control(holder=_seat(BEN), request=_request(ANNA)),
}
_READY = live(robot(RobotMode.READY, PlugState.PARKED))

SCENES = {
    f"control-{name}": _READY.model_copy(update={"control": control})
    for name, control in _CONTROLS.items()
}

REFUSED = _READY.model_copy(
    update={
        "control": Control(
            holder=_seat(BEN),
            answer=ControlAnswer(
                request_id="request", person=ANNA, by=BEN, answer="unanswered", at=NOW
            ),
        )
    }
)
"""What comes after ``control-asking`` when Ben says nothing."""
