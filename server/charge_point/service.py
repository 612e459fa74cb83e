"""Carries out what an energy manager wants, and remembers when a person wanted something else."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Coroutine
from dataclasses import replace

from drivers.station import StationDriver, StationError
from server.charge_point.counter import counted
from server.charge_point.errors import ChargePointError, RestingError, UnpluggingError
from server.charge_point.memory import RecordKeeper
from server.charge_point.view import WAY_OUT, activity, cp_state
from server.charge_point.watching import JobWatch
from server.config.charge_point import ChargePointSettings
from server.control.errors import StationUnsafeError
from server.control.model import PlugState
from server.control.supervisor import Supervisor
from server.errors import PlugPilotError
from server.jobs.model import JobPhase, JobType
from server.jobs.runner import JobRunner
from server.live.station_watch import StationWatch
from server.schema.charge_point import ChargePoint
from server.schema.jobs import Job, JobRequest
from server.storage.charge_point import ChargePointStore
from server.timing import Calendar

_log = logging.getLogger(__name__)

NAME = "The energy manager"
WRITE_EVERY_WH = 10.0


class ChargePointService:
    """One charger made of robot and station.

    Args:
        supervisor: Owner of the robot.
        runner: Runs the jobs.
        station: Gives the power.
        watch: Knows its newest reading.
        store: Keeps what must survive a restart.
        settings: Gives what holds now.
        calendar: Dates.
        speed: Seconds of the event loop per second of the dates.
    """

    def __init__(
        self,
        *,
        supervisor: Supervisor,
        runner: JobRunner,
        station: StationDriver,
        watch: StationWatch,
        store: ChargePointStore,
        settings: Callable[[], ChargePointSettings],
        calendar: Calendar,
        speed: float = 1.0,
    ) -> None:
        self._supervisor = supervisor
        self._runner = runner
        self._station = station
        self._watch = watch
        self._settings = settings
        self._calendar = calendar
        self._speed = speed
        self._keeper = RecordKeeper(store)
        self._jobs = JobWatch(runner, self._keeper, settings, charging=self._charging_began)
        self._one_at_a_time = asyncio.Lock()
        self._unplug_timer: asyncio.TimerHandle | None = None
        self._errands: set[asyncio.Task[None]] = set()
        self._written_wh = 0.0

    async def start(self) -> None:
        """Remember what was wanted before the restart."""
        await self._keeper.start()

    async def close(self) -> None:
        """Stop; the robot and the station stay as they are."""
        if self._unplug_timer is not None:
            self._unplug_timer.cancel()
        for task in list(self._errands):
            task.cancel()
        if self._errands:
            await asyncio.wait(self._errands)
        await self._keeper.close()

    def view(self) -> ChargePoint:
        """The charger now, from what is known already."""
        record, job = self._keeper.record, self._jobs.running
        mode, plug = self._supervisor.mode, self._supervisor.plug.state
        newest = self._watch.snapshot
        snapshot = newest if self._watch.online else None
        resting = record.resting
        return ChargePoint(
            cp_state=cp_state(mode=mode, plug=plug, snapshot=snapshot, resting=resting, job=job),
            enabled=record.enabled,
            power_w=round(snapshot.power_w, 1) if snapshot else 0.0,
            energy_kwh=round(record.energy_wh / 1000.0, 4),
            currents_a=_rounded(snapshot.currents_a) if snapshot else (0.0, 0.0, 0.0),
            contactor_closed=snapshot is not None and snapshot.contactor_closed,
            connector_locked=snapshot.connector_locked if snapshot else None,
            max_current_a=record.max_current_a,
            limits_current=self._station.capabilities.limits_current,
            robot_state=activity(mode=mode, plug=plug, snapshot=snapshot, job=job),
            resting=resting,
            updated_at=self._calendar.at(newest.sampled_at_s) if newest else None,
        )

    def station_read(self) -> None:
        """There is a new reading: count its energy."""
        snapshot = self._watch.snapshot
        if snapshot is None or not self._watch.online:
            return
        record = counted(self._keeper.record, snapshot.session_energy_wh)
        matters = abs(record.energy_wh - self._written_wh) >= WRITE_EVERY_WH
        if matters:
            self._written_wh = record.energy_wh
        self._keeper.keep(record, soon=matters)

    async def set_enabled(self, *, enabled: bool) -> ChargePoint:
        """Let the car charge, plugging it in first where needed; or let it charge no more.

        Disabled, the car stays plugged in.

        Raises:
            RestingError: a person must resume the charge point first.
            UnpluggingError: the robot is on its way out of the car.
            StationUnsafeError: the station does not answer.
            PlugPilotError: the job cannot be accepted; see JobRunner.create.
        """
        async with self._one_at_a_time:
            if enabled:
                await self._enable()
            else:
                await self._disable()
        return self.view()

    async def limit_current(self, current_a: float) -> ChargePoint:
        """Pass a limit on to a station that can, and remember it.

        Raises:
            StationUnsafeError: the station does not answer.
        """
        async with self._one_at_a_time:
            self._keeper.keep(replace(self._keeper.record, max_current_a=current_a))
            await self._apply_limit()
        return self.view()

    def resume(self) -> ChargePoint:
        """A person, or something that knows that the car has come, ends the rest."""
        self._jobs.end_rest()
        return self.view()

    async def _enable(self) -> None:
        record = self._keeper.record
        if record.resting is not None:
            raise RestingError(_WHY_RESTING[record.resting], reason=record.resting)
        job = self._jobs.running
        if job is None:
            job_id = await self._begin()
        else:
            job_id = await self._go_on(job)
        self._stop_timer()
        self._jobs.forbidden = False
        self._keeper.keep(replace(self._keeper.record, enabled=True, job_id=job_id))

    async def _begin(self) -> str | None:
        if self._supervisor.plug.state is PlugState.INSERTED:
            async with self._supervisor.control("job", NAME):
                await self._apply_limit()
                try:
                    await self._station.start()
                except StationError as error:
                    raise StationUnsafeError(str(error)) from error
            return self._keeper.record.job_id
        request = JobRequest(type=JobType.CHARGE, vehicle_id=self._settings().vehicle_id)
        return (await self._runner.create(request, key=None, digest=None)).id

    async def _go_on(self, job: Job) -> str:
        if job.type is JobType.UNPLUG or job.phase in WAY_OUT:
            raise UnpluggingError(f"The job is in the phase {job.phase.value}.", job_id=job.id)
        if job.paused and job.id != self._keeper.record.job_id:
            raise ChargePointError("Somebody has paused the job by hand.", job_id=job.id)
        if job.paused:
            await self._runner.resume(job.id)
        return job.id

    async def _disable(self) -> None:
        job = self._jobs.running
        self._jobs.forbidden = True
        self._keeper.keep(replace(self._keeper.record, enabled=False))
        if job is None:
            if self._supervisor.plug.state is PlugState.INSERTED:
                await self._power_off()
        elif job.phase is JobPhase.CHARGING and not job.paused:
            await self._pause(job)
        self._start_timer()

    async def _power_off(self) -> None:
        if not self._station.capabilities.switches:
            return
        try:
            await self._station.stop()
        except StationError as error:
            raise StationUnsafeError(str(error)) from error

    async def _pause(self, job: Job) -> None:
        self._jobs.pausing = job.id
        await self._runner.pause(job.id)
        self._keeper.keep(replace(self._keeper.record, job_id=job.id))

    def _charging_began(self, job: Job) -> None:
        """Called at the beginning of the phase, so what is to be done is done beside it."""
        self._later(self._as_wanted(job), "charge point: charging began")

    async def _as_wanted(self, job: Job) -> None:
        async with self._one_at_a_time:
            if self._jobs.forbidden and self._jobs.running is not None and not job.paused:
                await self._pause(job)
            else:
                await self._apply_limit()

    async def _apply_limit(self) -> None:
        limit_a = self._keeper.record.max_current_a
        if limit_a is None or not self._station.capabilities.limits_current:
            return
        try:
            await self._station.limit_current(limit_a)
        except StationError as error:
            raise StationUnsafeError(str(error)) from error

    def _start_timer(self) -> None:
        self._stop_timer()
        after_min = self._settings().unplug_after_disabled_min
        if after_min is not None:
            self._unplug_timer = asyncio.get_running_loop().call_later(
                after_min * 60.0 * self._speed,
                lambda: self._later(self._unplug(), "charge point: unplug"),
            )

    def _stop_timer(self) -> None:
        if self._unplug_timer is not None:
            self._unplug_timer.cancel()
            self._unplug_timer = None

    async def _unplug(self) -> None:
        """It has been disabled for long: take the plug out of the car."""
        async with self._one_at_a_time:
            job = self._jobs.running
            if self._keeper.record.enabled:
                return
            if job is not None and job.paused and job.id == self._keeper.record.job_id:
                self._jobs.ending = job.id
                await self._runner.cancel(job.id)
            elif job is None and self._supervisor.plug.state is PlugState.INSERTED:
                request = JobRequest(type=JobType.UNPLUG)
                created = await self._runner.create(request, key=None, digest=None)
                self._jobs.ending = created.id

    def _later(self, errand: Coroutine[None, None, None], name: str) -> None:
        async def carry_out() -> None:
            try:
                await errand
            except PlugPilotError as error:
                _log.warning("%s: %s", name, error)

        task = asyncio.create_task(carry_out(), name=name)
        self._errands.add(task)
        task.add_done_callback(self._errands.discard)


_WHY_RESTING = {
    "unplugged": "Somebody has unplugged the car.",
    "charged": "The car has charged and was unplugged.",
    "failed": "The robot has failed to plug the car in.",
}


def _rounded(currents_a: tuple[float, float, float]) -> tuple[float, float, float]:
    first, second, third = currents_a
    return round(first, 2), round(second, 2), round(third, 2)
