"""What every routine is."""

from __future__ import annotations

from typing import Protocol

from server.calibration.routines.check_routine import CheckResult
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.schema.routines import RoutineRequest
from server.schema.vehicles import Vehicle


class AnyRoutine(Protocol):
    """One run of a routine; after an interruption ``run`` goes on, or begins anew."""

    @property
    def request(self) -> RoutineRequest:
        """What was asked for."""

    @property
    def by(self) -> str:
        """Who asked."""

    @property
    def vehicle(self) -> Vehicle | None:
        """Whose label is looked at; None: none is."""

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration | CheckResult:
        """Measure, and say what was found.

        Raises:
            PlugPilotError: it cannot go on.
        """
