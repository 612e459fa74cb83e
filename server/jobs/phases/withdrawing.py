"""Pull the plug out along the insertion axis, watching force and station."""

from __future__ import annotations

import asyncio
import logging

from drivers.robot import FaultCode, RobotState
from drivers.station import StationDriver, StationError
from server.control.errors import ControlError, ForceLimitError, RobotFaultError
from server.control.force_watch import ForceWatch
from server.control.plug_guard import Corridor
from server.errors import InternalError, PlugPilotError
from server.jobs.context import JobContext
from server.jobs.errors import JobError, StationUnsafeError, StillLockedError
from server.jobs.model import JobPhase
from server.jobs.phases.releasing import why_not_safe
from twin.kinematics import gamma
from twin.motion import plan_straight_line

_log = logging.getLogger(__name__)

WATCH_S = 0.1
SILENCE_LIMIT_S = 1.0


async def run(job: JobContext) -> None:
    """Pull the plug out, or stop at the first sign that it must not be.

    Raises:
        StillLockedError: it takes more than the allowed force.
        StillUnderLoadError: current flows; the motion was stopped.
        StationUnsafeError: the station went silent; the motion was stopped.
    """
    await job.journal.begin(JobPhase.WITHDRAWING, "Pulling the plug out.")
    supervisor, settings = job.supervisor, job.settings.insertion
    # A plug that jammed on the way in may have made the board stall.
    await supervisor.release_stall(job.lease)
    await supervisor.set_force_limit(job.lease, settings.withdrawal_force_limit_n)
    guard = _Guard(settings.withdrawal_force_limit_n)
    watching = asyncio.create_task(guard.watch_station(job.station), name="station watch")
    try:
        await guard.first_reading.wait()
        guard.raise_alarm()
        corridor = supervisor.plug.corridor
        if corridor is None or not supervisor.telemetry.require().homed:
            await _withdraw_blindly(job, guard)
        else:
            await _withdraw(job, corridor, guard)
    except ForceLimitError as error:
        raise _still_locked(error, guard) from error
    except RobotFaultError as error:
        if error.context.get("fault") != FaultCode.STALL.value:
            raise
        raise _still_locked(error, guard) from error
    finally:
        watching.cancel()
        await asyncio.gather(watching, return_exceptions=True)
    await supervisor.plug.is_free()
    await job.journal.note(
        "withdrawn", "The plug is out.", max_pull_n=round(guard.forces.largest_pull_n, 1)
    )


def _still_locked(error: ControlError, guard: _Guard) -> StillLockedError:
    return StillLockedError(error.detail, max_pull_n=round(guard.forces.largest_pull_n, 1))


async def _withdraw(job: JobContext, corridor: Corridor, guard: _Guard) -> None:
    """Back to where the insertion began."""
    supervisor = job.supervisor
    at = supervisor.telemetry.require().commanded.position
    if at.rho3_mm <= corridor.clear_rho3_mm:
        return
    clear = gamma.forward(supervisor.geometry, at._replace(rho3_mm=corridor.clear_rho3_mm))
    plan = plan_straight_line(supervisor.geometry, supervisor.limits, at, clear)
    await supervisor.follow(job.lease, plan, guard.check)


async def _withdraw_blindly(job: JobContext, guard: _Guard) -> None:
    """Nobody knows how deep the plug is: all the way back, along the axis, to the switch."""
    homing = asyncio.create_task(job.supervisor.withdraw_home(job.lease), name="withdrawal")
    alarm = asyncio.create_task(guard.alarmed.wait(), name="station alarm")
    try:
        await asyncio.wait({homing, alarm}, return_when=asyncio.FIRST_COMPLETED)
        if not homing.done():
            await job.supervisor.halt(job.lease)
        await asyncio.gather(homing, return_exceptions=True)
        guard.raise_alarm()
        homing.result()
    finally:
        for task in (homing, alarm):
            task.cancel()
        await asyncio.gather(homing, alarm, return_exceptions=True)


class _Guard:
    """Stops the withdrawal on force, load or a silent station."""

    def __init__(self, limit_n: float) -> None:
        self.forces = ForceWatch(pull_limit_n=limit_n)
        self.first_reading = asyncio.Event()
        self.alarmed = asyncio.Event()
        self._alarm: PlugPilotError | None = None

    def raise_alarm(self) -> None:
        if self._alarm is not None:
            raise self._alarm

    def check(self, state: RobotState) -> None:
        self.raise_alarm()
        self.forces.check(state)

    async def watch_station(self, station: StationDriver) -> None:
        """Ends with an alarm, whatever happens to it: nobody pulls without a watch."""
        try:
            self._alarm = await _first_sign_of_danger(station, self.first_reading)
        except Exception:  # noqa: BLE001 - logged; whatever it is, the motion must stop
            _log.exception("the watch over the charging station failed")
            self._alarm = InternalError(
                "The watch over the charging station failed. The log has the details."
            )
        self.alarmed.set()
        self.first_reading.set()


async def _first_sign_of_danger(station: StationDriver, reading: asyncio.Event) -> JobError:
    """Watch the station until something speaks against pulling the plug.

    Args:
        station: The station.
        reading: Set once a reading has shown that it is safe to begin.
    """
    loop = asyncio.get_running_loop()
    heard_s = loop.time()
    while True:
        try:
            async with asyncio.timeout(SILENCE_LIMIT_S):
                snapshot = await station.snapshot()
        except (StationError, TimeoutError) as error:
            if loop.time() - heard_s >= SILENCE_LIMIT_S:
                return StationUnsafeError(
                    f"The charging station fell silent during the withdrawal. {error}".strip()
                )
        else:
            heard_s = loop.time()
            problem = why_not_safe(snapshot, station.capabilities, heard_s)
            if problem is not None:
                return problem
            reading.set()
        await asyncio.sleep(WATCH_S)
