"""Where a job stands, as its journal tells it entry by entry."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

from server.jobs.model import JobPhase
from server.jobs.turning_back import Return, TurnBack
from server.schema.jobs import JobEvent
from server.storage.jobs import PHASE_STARTED

INTERRUPTIONS = {"paused", "unpaused", "person_needed", "person_answered", "resumed"}
"""After one of these nothing goes on before the next phase begins."""


@dataclass(frozen=True, slots=True)
class Stage:
    """A phase under way.

    Attributes:
        phase: Which one.
        began_at: Date of its entry.
        clock_speed: Seconds of the robot per second of the dates.
        homing: The zero of each axis is sought in it.
    """

    phase: JobPhase
    began_at: datetime
    clock_speed: float = 1.0
    homing: bool = False


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a job has come.

    Attributes:
        stage: The phase under way; None before the first, and while the job is interrupted.
        turned: How it ends early, if it does.
        charging_done: It has charged and is to be unplugged.
        energy_before_wh: What the station's counter showed when the charging began.
    """

    stage: Stage | None = None
    turned: Return | None = None
    charging_done: bool = False
    energy_before_wh: float | None = None

    def after(self, event: JobEvent) -> Progress:
        """How far it has come with one more entry in its journal."""
        match event.kind:
            case kind if kind == PHASE_STARTED:
                speed = event.data.get("clock_speed", 1.0)
                return replace(self, stage=Stage(event.phase, event.at, speed))
            case "homing" if self.stage is not None:
                return replace(self, stage=replace(self.stage, homing=True))
            case "turned_back":
                return replace(self, stage=None, turned=TurnBack.from_data(event.data).how)
            case "charging_started":
                return replace(self, energy_before_wh=event.data["energy_before_wh"])
            case "charging_done":
                return replace(self, charging_done=True)
            case kind if kind in INTERRUPTIONS:
                return self.interrupted()
            case _:
                return self

    def interrupted(self) -> Progress:
        """The same without the phase, which does not go on where it was."""
        return replace(self, stage=None)
