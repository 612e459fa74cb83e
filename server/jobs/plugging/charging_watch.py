"""While the car charges nothing moves; this sees to it that nothing else goes wrong either."""

from __future__ import annotations

from drivers.station import PilotState, StationSnapshot
from server.control.errors import StationUnsafeError
from server.control.model import PlugState
from server.jobs.context import JobContext
from server.jobs.errors import CarGoneError

IN_A_ROW = 2
"""One reading may be a contact that bounced, or a meter that looked at the wrong moment."""


class ChargingWatch:
    """Judges every reading of the station while the plug rests in the socket.

    Args:
        job: The job.
        heard_s: When the station was heard last, event loop time.
    """

    def __init__(self, job: JobContext, heard_s: float) -> None:
        self._job = job
        self._heard_s = heard_s
        self._faults = 0
        self._without_car = 0
        self._depth_rho3_mm = _measured_rho3_mm(job)

    async def check(self, snapshot: StationSnapshot | None, now_s: float, why: str = "") -> None:
        """Take in a reading.

        Args:
            snapshot: The reading; None when there was none.
            now_s: Event loop time.
            why: What the station's driver said about a missing reading.

        Raises:
            StationUnsafeError: the station reports a fault, or has been silent for too long: its
                readings count by when they were taken, so one that repeats itself is silent.
            CarGoneError: the station no longer sees the car, or the plug has moved.
        """
        if snapshot is not None and snapshot.sampled_at_s <= now_s:
            self._heard_s = max(self._heard_s, snapshot.sampled_at_s)
        self._refuse_silence(now_s, why)
        await self._refuse_moved_plug()
        if snapshot is not None:
            self._refuse_fault(snapshot)
            await self._refuse_without_car(snapshot)

    def _refuse_silence(self, now_s: float, why: str) -> None:
        silent_s = now_s - self._heard_s
        if silent_s > self._job.settings.supervision.charging_silence_s:
            raise StationUnsafeError(
                f"The charging station has been silent for {silent_s:.0f} s. {why}".strip(),
                age_s=round(silent_s, 1),
            )

    def _refuse_fault(self, snapshot: StationSnapshot) -> None:
        faulty = snapshot.pilot in {PilotState.E, PilotState.F}
        self._faults = self._faults + 1 if faulty else 0
        if self._faults >= IN_A_ROW:
            raise StationUnsafeError(
                f"The charging station reports a fault (state {snapshot.pilot.value}).",
                pilot=snapshot.pilot.value,
            )

    async def _refuse_without_car(self, snapshot: StationSnapshot) -> None:
        gone = snapshot.pilot is PilotState.A
        self._without_car = self._without_car + 1 if gone else 0
        if self._without_car >= IN_A_ROW:
            await self._lose("The charging station no longer sees a car.")

    async def _refuse_moved_plug(self) -> None:
        rho3_mm = _measured_rho3_mm(self._job)
        if rho3_mm is None:
            return  # the link is down; nothing moves, and the board's record settles it later
        if self._depth_rho3_mm is None:
            self._depth_rho3_mm = rho3_mm
        moved_mm = abs(rho3_mm - self._depth_rho3_mm)
        if moved_mm > self._job.settings.insertion.depth_tolerance_mm:
            await self._lose(f"The plug has moved by {moved_mm:.1f} mm while the car charged.")

    async def _lose(self, what: str) -> None:
        """Somebody pulled the plug, or the car drove off: where it is now, a person must say."""
        if self._job.supervisor.plug.state is PlugState.INSERTED:
            await self._job.supervisor.plug.doubt()
        raise CarGoneError(what)


def _measured_rho3_mm(job: JobContext) -> float | None:
    state = job.supervisor.telemetry.latest
    return state.measured.position.rho3_mm if state is not None and state.homed else None
