"""Learns from jobs, keeps the robot accurate in small steps, and says what it has found."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Coroutine

import numpy as np
from numpy.typing import NDArray

from server.calibration.drift.belts import BeltMemory, seen_shift
from server.calibration.drift.judging import belt_hints, drift_of, moved_mm
from server.calibration.drift.memory import NOTE, DriftMemory
from server.calibration.drift.observing import JobObserver, Observation
from server.calibration.force.insertions import Insertions, hints_of
from server.calibration.grade import Grade
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.service import Calibrations
from server.calibration.versions.values import rotation_vector
from server.config.settings import Settings
from server.control.errors import ControlError
from server.control.plug_guard import HELD
from server.control.supervisor import Supervisor
from server.errors import PlugPilotError
from server.jobs.plugging.search import further_tries
from server.jobs.runner import JobRunner
from server.localisation.eye import Eye
from server.schema.calibrations import RobotEvidence, RobotValues
from server.schema.drift import DriftReport
from server.schema.jobs import Job
from server.schema.vehicles import Vehicle
from server.storage.calibration_notes import CalibrationNotes
from server.storage.vehicles import VehicleStore
from server.timing import Calendar
from twin.as_built import PlanarAsBuilt

_log = logging.getLogger(__name__)

MAKER = "PlugPilot"
JOBS_BETWEEN = 10
"""Jobs to be learnt from before the next version."""
WORTH_MM = 0.05
"""A smaller change of the nine places is not worth a version."""
MOST_AT_ONCE = 5e-4
"""Of a belt, from one version to the next: 0.1 mm over the regular box."""


class SelfCalibration:
    """Every successful job teaches something.

    Args:
        supervisor: Owner of the robot.
        runner: Gives the jobs.
        eye: Gives what they see.
        vehicles: Whose labels there are.
        calibrations: Keeps versions and puts them in force.
        notes: Keeps what was learnt.
        settings: The whole configuration.
        calendar: Dates.
    """

    def __init__(
        self,
        *,
        supervisor: Supervisor,
        runner: JobRunner,
        eye: Eye,
        vehicles: VehicleStore,
        calibrations: Calibrations,
        notes: CalibrationNotes,
        settings: Settings,
        calendar: Calendar,
    ) -> None:
        self._supervisor = supervisor
        self._eye = eye
        self._vehicles = vehicles
        self._calibrations = calibrations
        self._notes = notes
        self._settings = settings
        self._calendar = calendar
        self._memory = DriftMemory()
        self._known: dict[str, Vehicle] = {}
        self._listeners: list[Callable[[], None]] = []
        self._tasks: set[asyncio.Task[None]] = set()
        self._turn = asyncio.Lock()
        self._pending = True
        supervisor.listen(self._correct_when_free)
        JobObserver(supervisor, runner, eye, self._job_done)

    @property
    def report(self) -> DriftReport:
        """Everything that jobs have taught."""
        memory = self._memory
        belts = drift_of(
            memory.belts, self._supervisor.geometry, self._measured, memory.measured_error_mm
        )
        force = self._calibrations.in_force.force
        felt = {key: one for key, one in memory.insertions.items() if key in self._known}
        hints = [
            hint
            for vehicle_id, one in felt.items()
            for hint in hints_of(self._known[vehicle_id], one, force)
        ]
        return DriftReport(
            belts=belts,
            hints=[*belt_hints(belts), *hints],
            insertions=[one.shown(vehicle_id) for vehicle_id, one in felt.items()],
        )

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` when something new was learnt."""
        self._listeners.append(listener)

    async def start(self) -> None:
        """Remember what was learnt before."""
        self._memory = await self._notes.read_as(DriftMemory, NOTE) or self._memory
        self._begin_anew_if_changed()
        self._known = {vehicle.id: vehicle for vehicle in await self._vehicles.all()}

    async def close(self) -> None:
        """Finish what is being learnt."""
        await self.settled()

    async def settled(self) -> None:
        """Wait until what jobs have shown was taken in."""
        while self._tasks:
            await asyncio.wait(self._tasks)

    # Inside

    @property
    def _measured(self) -> PlanarAsBuilt:
        return self._memory.measured or PlanarAsBuilt.as_drawn(self._supervisor.geometry)

    def _job_done(self, job: Job, observed: Observation) -> None:
        self._do(self._take_in(job, observed))

    def _correct_when_free(self) -> None:
        """As soon as nobody uses the robot and the plug is out; until then it waits."""
        free = self._supervisor.holder is None and self._supervisor.plug.state not in HELD
        if self._pending and free and self._correction_is_due:
            self._pending = False
            self._do(self._correct())

    def _do(self, work: Coroutine[None, None, None]) -> None:
        task = asyncio.create_task(self._in_turn(work), name="self-calibration")
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _in_turn(self, work: Coroutine[None, None, None]) -> None:
        async with self._turn:
            try:
                await work
            except PlugPilotError as error:
                _log.warning("self-calibration: %s", error.detail)
        for listener in self._listeners:
            listener()

    async def _take_in(self, job: Job, observed: Observation) -> None:
        self._begin_anew_if_changed()
        self._known = {vehicle.id: vehicle for vehicle in await self._vehicles.all()}
        vehicle_id = job.vehicle_id
        if vehicle_id is None or vehicle_id not in self._known:
            return
        pair = observed.pair(vehicle_id)
        memory = self._memory
        if pair is not None:
            attitude = self._eye.mount.T_platform_camera[:3, :3]
            belts = memory.belts.learn(seen_shift(self._measured, attitude, pair))
            memory = memory.model_copy(update={"belts": belts})
        felt = memory.insertions.get(vehicle_id, Insertions())
        felt = felt.taken(tuple(observed.curve.summary()), self._offset_mm(observed.tries))
        insertions = {**memory.insertions, vehicle_id: felt}
        await self._remember(memory.model_copy(update={"insertions": insertions}))
        self._pending = True
        self._correct_when_free()

    def _offset_mm(self, tries: int) -> tuple[float, float]:
        """How far beside the measured place the plug went in after so many tries that failed."""
        further = list(further_tries(self._settings.insertion))
        if tries == 0 or tries > len(further):
            return 0.0, 0.0
        return further[tries - 1].right_mm, further[tries - 1].up_mm

    def _begin_anew_if_changed(self) -> None:
        """Somebody has put another calibration in force, or taken ours back: that one counts."""
        scale = self._calibrations.in_force.force_scale
        if scale != self._memory.force_scale:  # what was felt before counts in other newtons
            self._memory = self._memory.model_copy(update={"force_scale": scale, "insertions": {}})
        in_force = self._calibrations.robot_in_force
        if in_force == self._memory.in_force_id:
            return
        self._memory = DriftMemory(
            measured=self._calibrations.in_force.mechanism,
            measured_error_mm=self._calibrations.robot_error_mm,
            in_force_id=in_force,
            insertions=self._memory.insertions,
            force_scale=scale,
        )

    @property
    def _correction_is_due(self) -> bool:
        return self._memory.belts.jobs - self._memory.jobs_at_version >= JOBS_BETWEEN

    async def _correct(self) -> None:
        """Put a small correction in force, where it is worth it."""
        self._begin_anew_if_changed()
        memory = self._memory
        if not self._correction_is_due:
            return
        in_use = self._calibrations.in_force.mechanism or self._measured
        wanted = _no_further(in_use, memory.belts.corrected(self._measured))
        if moved_mm(self._supervisor.geometry, in_use, wanted) < WORTH_MM:
            return
        kept = await self._calibrations.keep(self._version(memory.belts, in_use, wanted))
        try:
            await self._calibrations.activate(kept.id, by=MAKER, accept_worse=True)
        except ControlError as error:
            _log.info("the correction waits for the next job: %s", error.detail)
            return
        await self._remember(
            memory.model_copy(update={"in_force_id": kept.id, "jobs_at_version": memory.belts.jobs})
        )

    def _version(
        self, belts: BeltMemory, in_use: PlanarAsBuilt, wanted: PlanarAsBuilt
    ) -> NewCalibration:
        left_sigma, right_sigma = belts.belts_sigma.tolist()
        drift = self.report.belts
        remarks = [hint.text for hint in belt_hints(drift)]
        return NewCalibration(
            values=RobotValues(
                mechanism=wanted,
                camera_rotation_rad=rotation_vector(self._eye.mount.T_platform_camera[:3, :3]),
            ),
            made_by=MAKER,
            source=f"Drift of the belts, seen in {belts.jobs} jobs",
            grade=Grade.USABLE if remarks else Grade.GOOD,
            remarks=tuple(remarks),
            error=belts.misses_mm(_change(self._measured, wanted)),
            error_in_use=belts.misses_mm(_change(self._measured, in_use)),
            evidence=RobotEvidence(
                looks=[],
                sigma={"left_scale": left_sigma, "right_scale": right_sigma},
                unseen=["Legs, rails and camera: jobs tell of the belts only."],
                duration_s=0.0,
                provenance="drift",
            ),
        )

    async def _remember(self, memory: DriftMemory) -> None:
        self._memory = memory
        await self._notes.write(NOTE, memory.model_dump(mode="json"), self._calendar.now())


def _change(measured: PlanarAsBuilt, other: PlanarAsBuilt) -> NDArray[np.float64]:
    return np.array(
        [other.left_scale - measured.left_scale, other.right_scale - measured.right_scale]
    )


def _no_further(in_use: PlanarAsBuilt, wanted: PlanarAsBuilt) -> PlanarAsBuilt:
    """Towards what is wanted, no further at once than a belt changes by itself."""
    left, right = np.clip(_change(in_use, wanted), -MOST_AT_ONCE, MOST_AT_ONCE).tolist()
    return in_use.model_copy(
        update={
            "left_scale": in_use.left_scale + left,
            "right_scale": in_use.right_scale + right,
        }
    )
