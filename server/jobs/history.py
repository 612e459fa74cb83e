"""What a job's journal says about how far it has come."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from server.jobs.model import JobPhase
from server.jobs.turning_back import TurnBack
from server.schema.jobs import JobEvent


@dataclass(frozen=True, slots=True)
class History:
    """The past of a job.

    Attributes:
        turn_back: What made it turn back last, if anything did.
        charging_done: It has charged and is to be unplugged.
        energy_before_wh: What the station's counter showed when the charging began.
        resumptions: After how many restarts it went on, by the phase it was in then, since a
            person has last been asked.
    """

    turn_back: TurnBack | None
    charging_done: bool
    energy_before_wh: float | None
    resumptions: dict[JobPhase, int]


def history_of(events: Sequence[JobEvent]) -> History:
    """Read a journal, oldest entry first."""
    turn_back: TurnBack | None = None
    charging_done = False
    energy_before_wh: float | None = None
    resumptions: dict[JobPhase, int] = {}
    for event in events:
        match event.kind:
            case "turned_back":
                turn_back = TurnBack.from_data(event.data)
            case "charging_done":
                charging_done = True
            case "charging_started":
                energy_before_wh = event.data["energy_before_wh"]
            case "resumed" if event.data["after_restart"]:
                phase = JobPhase(event.data["phase"])
                resumptions[phase] = resumptions.get(phase, 0) + 1
            case "person_answered":
                resumptions.clear()
            case _:
                pass
    return History(turn_back, charging_done, energy_before_wh, resumptions)
