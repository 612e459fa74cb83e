"""Everything that measures the robot, put together."""

from __future__ import annotations

from dataclasses import dataclass

from server.calibration.drift.service import SelfCalibration
from server.calibration.routines.desk import RoutineDesk
from server.calibration.versions.service import Calibrations
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.jobs.runner import JobRunner
from server.localisation.eye import Eye
from server.storage.accuracy_checks import AccuracyCheckStore
from server.storage.calibration_notes import CalibrationNotes
from server.storage.database import Database
from server.storage.vehicles import VehicleStore
from server.timing import Calendar


@dataclass(frozen=True, slots=True)
class Measuring:
    """What measures the robot.

    Attributes:
        routines: On purpose.
        drift: On the way, in jobs.
        checks: Keeps nine-point checks.
    """

    routines: RoutineDesk
    drift: SelfCalibration
    checks: AccuracyCheckStore

    @classmethod
    def of(
        cls,
        database: Database,
        *,
        supervisor: Supervisor,
        eye: Eye,
        runner: JobRunner,
        vehicles: VehicleStore,
        calibrations: Calibrations,
        settings: Settings,
        calendar: Calendar,
    ) -> Measuring:
        """Put it together; nothing moves by it."""
        checks, notes = AccuracyCheckStore(database), CalibrationNotes(database)
        routines = RoutineDesk(
            supervisor=supervisor,
            eye=eye,
            vehicles=vehicles,
            calibrations=calibrations,
            settings=settings,
            calendar=calendar,
            checks=checks,
            notes=notes,
        )
        drift = SelfCalibration(
            supervisor=supervisor,
            runner=runner,
            eye=eye,
            vehicles=vehicles,
            calibrations=calibrations,
            notes=notes,
            settings=settings,
            calendar=calendar,
        )
        return cls(routines, drift, checks)

    async def start(self) -> None:
        """Remember what was under way, and what was learnt."""
        await self.routines.start()
        await self.drift.start()

    async def close(self) -> None:
        """Stop whatever is under way."""
        await self.routines.close()
        await self.drift.close()
