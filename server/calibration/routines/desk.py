"""Runs one calibration routine at a time, and shows how far it is."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from datetime import datetime
from typing import Literal

from server.calibration.camera.errors import CalibrationDivergedError
from server.calibration.robot.errors import RobotCalibrationError
from server.calibration.routines.board_feed import BoardFeed
from server.calibration.routines.check_record import check_of
from server.calibration.routines.check_routine import CheckResult
from server.calibration.routines.choice import routine_for
from server.calibration.routines.errors import (
    AxesSwappedError,
    LabelMovedError,
    MotorReversedError,
    NoRoutineError,
    RoutineLostError,
    RoutineRunningError,
)
from server.calibration.routines.figures import figures_of, verdict_of
from server.calibration.routines.progress import Progress
from server.calibration.routines.robot_memory import RobotMemory
from server.calibration.routines.robot_routine import RobotRoutine
from server.calibration.routines.routine import AnyRoutine
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.service import HOLDER, Calibrations
from server.config.settings import Settings
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.errors import InternalError, PlugPilotError
from server.localisation.eye import Eye
from server.schema.problem import problem_from
from server.schema.routines import Routine, RoutineAnswer, RoutineRequest
from server.storage.accuracy_checks import AccuracyCheckStore
from server.storage.calibration_notes import CalibrationNotes
from server.storage.errors import StorageError
from server.storage.vehicles import VehicleStore
from server.timing import Calendar

_log = logging.getLogger(__name__)

NOTE = "routine"
"""Under this name the newest routine is kept, for the next start."""
LOOKS = "routine looks"
"""Under this one what it has collected."""

State = Literal["running", "interrupted", "finished", "failed", "cancelled"]

_FINAL = (
    LabelMovedError,
    AxesSwappedError,
    MotorReversedError,
    RobotCalibrationError,
    CalibrationDivergedError,
)
"""What cannot be mended by going on; after anything else a routine can be resumed."""


class RoutineDesk:
    """The one routine.

    Args:
        supervisor: Owner of the robot.
        eye: Camera and locator.
        vehicles: Whose labels there are.
        calibrations: Keeps what comes of it.
        settings: The whole configuration.
        calendar: Dates.
        checks: Keeps nine-point checks.
        notes: Keeps what was under way.

    Attributes:
        board: What the camera routine sees.
    """

    def __init__(
        self,
        *,
        supervisor: Supervisor,
        eye: Eye,
        vehicles: VehicleStore,
        calibrations: Calibrations,
        settings: Settings,
        calendar: Calendar,
        checks: AccuracyCheckStore,
        notes: CalibrationNotes,
    ) -> None:
        self.board = BoardFeed()
        self._supervisor = supervisor
        self._eye = eye
        self._vehicles = vehicles
        self._calibrations = calibrations
        self._settings = settings
        self._calendar = calendar
        self._listeners: list[Callable[[], None]] = []
        self._routine: AnyRoutine | None = None
        self._progress = Progress(self._changed)
        self._state: State = "cancelled"
        self._begun_at: datetime = calendar.now()
        self._problem: PlugPilotError | None = None
        self._kept: str | None = None
        self._check: str | None = None
        self._checks = checks
        self._notes = notes
        self._before: Routine | None = None
        self._found: NewCalibration | CheckResult | None = None
        self._task: asyncio.Task[None] | None = None

    @property
    def shown(self) -> Routine | None:
        """The routine under way, or the last one; None before there was any."""
        return self._before if self._routine is None else self._show(self._routine)

    async def start(self) -> None:
        """Say what became of the routine that was under way when PlugPilot ended.

        Where the looks of it are kept it can be resumed: it looks first whether the label is where
        it was. What any other had seen is gone. What it has found is a version, or none: there is
        nothing in between.
        """
        before = await self._notes.read_as(Routine, NOTE)
        if before is None:
            return
        if before.state in {"running", "interrupted"}:
            if await self._recall(before):
                return
            lost = RoutineLostError(
                "What it had seen is given up, because nobody knows whether the car has moved "
                "meanwhile. Nothing was kept, and nothing was put in force."
            )
            before = before.model_copy(
                update={"state": "failed", "asks": None, "problem": problem_from(lost)}
            )
            await self._write(before)
        self._before = before

    async def _recall(self, before: Routine) -> bool:
        """Take up a routine whose looks are kept, if they are."""
        memory = await self._notes.read_as(RobotMemory, LOOKS)
        if memory is None or memory.begun_at != before.begun_at:
            return False
        known = {vehicle.id: vehicle for vehicle in await self._vehicles.all()}
        if memory.vehicle_id not in known:
            return False
        vehicle = known[memory.vehicle_id]
        self._routine = RobotRoutine.recalled(memory, before.begun_by, vehicle)
        self._progress = Progress(
            self._changed, before.doing, before.done, before.total, list(before.looks)
        )
        self._begun_at, self._state = before.begun_at, "interrupted"
        return True

    def _show(self, routine: AnyRoutine) -> Routine:
        progress = self._progress
        verdict, remarks = verdict_of(self._found)
        return Routine(
            kind=routine.request.kind,
            state=self._state,
            doing=progress.doing,
            done=progress.done,
            total=progress.total,
            looks=list(progress.looks),
            begun_by=routine.by,
            begun_at=self._begun_at,
            calibration_id=self._kept,
            check_id=self._check,
            problem=problem_from(self._problem) if self._problem else None,
            asks=progress.asks,
            verdict=verdict,
            remarks=list(remarks),
            figures=figures_of(self._found) if self._found else [],
        )

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever there is something new."""
        self._listeners.append(listener)

    async def begin(self, request: RoutineRequest, by: str) -> Routine:
        """Begin a routine; what an interrupted one has collected is given up.

        Raises:
            RoutineRunningError: one is under way.
            UnknownVehicleError, VehicleChoiceError: it is not clear whose label to look at.
            ControlBusyError: a job, or somebody else, uses the robot.
        """
        self._refuse_second()
        routine = await routine_for(request, by, self._vehicles)
        self._refuse_second()
        lease = self._supervisor.acquire("calibration", HOLDER)
        self._routine = routine
        self._progress = Progress(self._changed)
        self._begun_at = self._calendar.now()
        self._kept = self._check = self._found = None
        shown = self._go_on(self._routine, lease)
        await self._write(shown)
        return shown

    async def resume(self) -> Routine:
        """Go on where the routine was interrupted.

        Raises:
            NoRoutineError: none was.
            ControlBusyError: a job, or somebody else, uses the robot.
        """
        if self._routine is None or self._state != "interrupted":
            raise NoRoutineError("No calibration was interrupted.")
        lease = self._supervisor.acquire("calibration", HOLDER)
        return self._go_on(self._routine, lease)

    def confirm(self, answer: RoutineAnswer) -> Routine:
        """Answer what the routine asks.

        Raises:
            NoRoutineError: none is under way.
            NoQuestionError: it asks nothing, or something else.
            AnswerUnfitError: the number is missing, or cannot be right.
        """
        if self._routine is None or self._state != "running":
            raise NoRoutineError("No calibration is under way.")
        self._progress.take_answer(answer)
        return self._show(self._routine)

    async def cancel(self) -> Routine:
        """End the routine; the robot comes to rest, and nothing is kept.

        Raises:
            NoRoutineError: none is under way.
        """
        if self._routine is None or self._state not in {"running", "interrupted"}:
            raise NoRoutineError("No calibration is under way.")
        await self._end_task()
        if self._state in {"running", "interrupted"}:  # it may just have ended
            self._state = "cancelled"
        self._changed()
        await self._write(self._show(self._routine))
        return self._show(self._routine)

    async def wait(self) -> None:
        """Wait until the routine has ended, or was interrupted."""
        if self._task is not None:
            await asyncio.wait({self._task})

    async def close(self) -> None:
        """Stop whatever is under way."""
        await self._end_task()

    def _go_on(self, routine: AnyRoutine, lease: Lease) -> Routine:
        self._state, self._problem = "running", None
        if routine.request.kind == "camera":
            self.board.open()
        self._task = asyncio.create_task(self._run(routine, lease), name="calibration")
        # Not in the task: one that is cancelled before its first step never runs.
        self._task.add_done_callback(lambda _: self._supervisor.give_back(lease))
        self._changed()
        return self._show(routine)

    async def _run(self, routine: AnyRoutine, lease: Lease) -> None:
        stand = Stand(
            supervisor=self._supervisor,
            lease=lease,
            eye=self._eye,
            owner=routine.vehicle,
            settings=self._settings,
            as_taught=self._calibrations.as_taught,
            in_force=self._calibrations.in_force,
            evidence=self._calibrations.robot_evidence,
            board=self.board,
            remember=self._remember,
        )
        try:
            found = await routine.run(stand, self._progress)
            await self._keep(found)
        except PlugPilotError as error:
            _log.warning("the calibration stands still: %s", error.detail)
            self._problem = error
            self._state = "failed" if isinstance(error, _FINAL) else "interrupted"
        except Exception:  # noqa: BLE001 - it is logged, and shown as failed
            _log.exception("the calibration broke down")
            self._problem = InternalError("The calibration broke down. The log says why.")
            self._state = "failed"
        else:
            self._state = "finished"
        await self.board.close()
        self._changed()
        await self._write(self._show(routine))

    async def _write(self, routine: Routine) -> None:
        """For the next start. A disk that does not take it ends no calibration."""
        try:
            await self._notes.write(NOTE, routine.model_dump(mode="json"), self._calendar.now())
        except StorageError as error:
            _log.warning("how far the calibration is could not be kept: %s", error.detail)

    async def _remember(self, memory: RobotMemory) -> None:
        """For the next start, like ``_write``: how far it is, and what it rests on."""
        if self._routine is None:
            return
        kept = memory.model_copy(update={"begun_at": self._begun_at})
        try:
            await self._notes.write(LOOKS, kept.model_dump(mode="json"), self._calendar.now())
        except StorageError as error:
            _log.warning("the looks of the calibration could not be kept: %s", error.detail)
        await self._write(self._show(self._routine))

    async def _keep(self, found: NewCalibration | CheckResult) -> None:
        self._found = found
        if isinstance(found, CheckResult):
            check = check_of(found, self._calendar.now(), self._calibrations.robot_in_force)
            await self._checks.add(check)
            self._check = check.id
            self._progress.doing = "The check is done."
        else:
            self._kept = (await self._calibrations.keep(found)).id
            self._progress.doing = "The calibration is done. Nobody uses it yet."

    async def _end_task(self) -> None:
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})
        await self.board.close()

    def _refuse_second(self) -> None:
        if self._state == "running":
            raise RoutineRunningError("One calibration at a time.")

    def _changed(self) -> None:
        for listener in self._listeners:
            listener()
