"""What the go-e charger answers."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from drivers.station.protocol import PilotState
from drivers.station.web import Answer

IDLE, CHARGING, WAITING, COMPLETE = 1, 2, 3, 4
CONTACTOR_STUCK = 9
NEUTRAL, OFF, ON = 0, 1, 2
LOCK_STATES = {1: False, 3: True, 4: False}

Reading = Annotated[float, Field(ge=-1e6, le=1e6)]

QUERY = "/api/status?filter=car,alw,frc,nrg,wh,cus,err,rbt"


class Status(Answer):
    """GET /api/status with the filter above.

    Attributes:
        car: 1 idle, 2 charging, 3 waits for the car, 4 complete, 5 error, 0 unknown.
        alw: The car may charge.
        frc: 0 neutral, 1 off, 2 on.
        nrg: Voltages of 3 phases and N [V], 3 currents [A], 4 powers and their sum [W],
            4 power factors.
        wh: Energy since the car was connected [Wh].
        cus: Lock of the cable: 1 unlocked, 2 unlocking failed, 3 locked, 4 locking failed.
        err: 0 none, 9 contactor stuck.
        rbt: Time since it was started [ms].
    """

    car: Annotated[int, Field(ge=0, le=5)]
    alw: bool
    frc: Annotated[int, Field(ge=0, le=2)]
    nrg: Annotated[tuple[Reading, ...], Field(min_length=16, max_length=16)]
    wh: Annotated[float, Field(ge=0, le=1e6)]
    cus: int | None = None
    err: int | None = None
    rbt: int | None = None

    @property
    def pilot(self) -> PilotState:
        """Control pilot state; what it does not know counts as a fault."""
        if self.err:
            return PilotState.F
        states = {
            IDLE: PilotState.A,
            CHARGING: PilotState.C,
            WAITING: PilotState.B,
            COMPLETE: PilotState.B,
        }
        return states.get(self.car, PilotState.F)

    @property
    def currents_a(self) -> tuple[float, float, float]:
        """Sizes of the phase currents [A]."""
        return (abs(self.nrg[4]), abs(self.nrg[5]), abs(self.nrg[6]))

    @property
    def power_w(self) -> float:
        """Sum of the phases [W]."""
        return abs(self.nrg[11])


class Setting(Answer):
    """GET /api/set?frc=... or amp=...: true, or what is wrong."""

    frc: bool | str | None = None
    amp: bool | str | None = None
