"""Records every job as it happens, and never holds the robot up for it.

What happens is put into a bounded queue; a task takes it from there and has it written by a worker
thread. When the disk is too slow the queue is full and messages are left out; how many is in the
recording. When the disk is full the job goes on without a recording, and its journal says so.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable

from drivers.camera import Frame
from drivers.robot import RobotState
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.divergence import DivergenceWatcher
from server.divergence.report import divergence_report
from server.jobs.model import JobState
from server.jobs.runner import JobRunner
from server.live.station_watch import StationWatch
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.recordings import records, topics
from server.recordings.picture_choice import PictureChoice
from server.recordings.session import RecordingSession
from server.recordings.store import RecordingStore
from server.schema.jobs import Job, JobEvent
from server.storage.errors import StorageError
from server.timing import Calendar
from twin.divergence import Change, Entry
from twin.divergence.insertion_force import InsertionForce

_log = logging.getLogger(__name__)

REST_PERIOD_S = 1.0
"""While nothing moves, one sample of the robot in so long."""


class Recorder:
    """Listens to all parts of PlugPilot and writes down what concerns the running job.

    Args:
        store: Where recordings are kept.
        settings: The whole configuration.
        calendar: Dates.
        supervisor: Gives telemetry.
        runner: Gives jobs and their journals.
        eye: Gives sightings.
        station: Gives readings of the station.
        divergence: Gives what the model finds.
        finished: Called with the id of a job whose recording is complete.
    """

    def __init__(
        self,
        *,
        store: RecordingStore,
        settings: Settings,
        calendar: Calendar,
        supervisor: Supervisor,
        runner: JobRunner,
        eye: Eye,
        station: StationWatch,
        divergence: DivergenceWatcher,
        finished: Callable[[str], None],
    ) -> None:
        self._store = store
        self._settings = settings
        self._calendar = calendar
        self._supervisor = supervisor
        self._runner = runner
        self._station = station
        self._finished = finished
        self._force = InsertionForce(settings.divergence.force)
        self._session: RecordingSession | None = None
        self._pictures = PictureChoice(0, 0.0)
        self._task: asyncio.Task[None] | None = None
        self._job_id = ""
        self._seen: RobotState | None = None
        self._written_s = float("-inf")
        supervisor.listen(self._robot_changed)
        runner.listen(self._job_changed)
        runner.listen_to_journal(self._entry_written)
        eye.listen(self._socket_seen)
        divergence.listen(self._parted)

    def start(self) -> None:
        """Take up the folder, in the background: repairing what a power cut has left takes time."""
        if self._store.enabled:
            self._task = asyncio.create_task(self._open(), name="recordings")

    async def close(self) -> None:
        """Finish the recording of a job that is interrupted."""
        if self._session is not None:
            self._session.end()
        if self._task is not None:
            await asyncio.wait({self._task})

    def station_changed(self) -> None:
        """The station was read."""
        if self._session is not None:
            record = records.station_record(self._station.snapshot, online=self._station.online)
            self._session.put(topics.STATION, self._now_s(), lambda: record)

    def _job_changed(self) -> None:
        job = self._runner.newest
        if job is None or not self._store.enabled:
            return
        if job.state is JobState.RUNNING and job.id != self._job_id:
            self._begin(job)
        elif job.state.ended and self._session is not None:
            # The last entry of the journal is told after this.
            asyncio.get_running_loop().call_soon(self._session.end)

    def _begin(self, job: Job) -> None:
        self._job_id = job.id
        began_at = self._calendar.now()
        session = RecordingSession(
            lambda: self._store.begin(job.id),
            began_at=began_at,
            began_s=self._now_s(),
            largest_mb=self._settings.recordings.max_one_mb,
        )
        header = records.header_record(self._settings, job, self._supervisor.name, began_at)
        session.put(topics.HEADER, self._now_s(), lambda: header)
        limits = self._settings.recordings
        self._pictures = PictureChoice(limits.pictures, limits.picture_interval_s)
        self._written_s = float("-inf")
        before, self._session = self._task, session
        self._task = asyncio.create_task(self._record(session, job.id, before), name="recorder")

    async def _record(
        self, session: RecordingSession, job_id: str, before: asyncio.Task[None] | None
    ) -> None:
        if before is not None:
            await asyncio.wait({before})
        trouble = await session.write(lambda: self._pictures.left_out)
        if self._session is session:
            self._session = None
        self._store.ended()
        if trouble is not None:
            await self._note("recording_failed", f"This job is not recorded: {trouble}.")
            return
        if session.full:
            await self._note("recording_full", "The recording is full; the job goes on.")
        self._finished(job_id)

    async def _note(self, kind: str, message: str) -> None:
        _log.warning("%s", message)
        try:
            await self._runner.note(kind, message)
        except StorageError as error:
            _log.warning("that could not be written into the journal: %s", error)

    async def _open(self) -> None:
        try:
            await asyncio.to_thread(self._store.open)
        except OSError as error:
            _log.warning("the folder of the recordings cannot be used: %s", error)

    def _robot_changed(self) -> None:
        state, session = self._supervisor.telemetry.latest, self._session
        if session is None or state is None or state is self._seen:
            return
        resting = self._seen is not None and state.measured.position == self._seen.measured.position
        resting = resting and state.board is self._seen.board  # type: ignore[union-attr]
        self._seen = state
        if resting and state.sampled_at_s - self._written_s < REST_PERIOD_S:
            return
        self._written_s = state.sampled_at_s
        supervisor = self._supervisor
        mode, plug = supervisor.mode.value, supervisor.plug.state.value
        geometry = supervisor.geometry
        session.put(
            topics.ROBOT,
            state.sampled_at_s,
            lambda: records.robot_record(state, mode, plug, geometry),
        )
        corridor, socket = supervisor.plug.corridor, self._runner.socket
        if corridor is not None:
            sigma_mm = 0.0 if socket is None else socket.depth_sigma_mm
            entry = Entry(corridor.face_rho3_mm, sigma_mm)
            session.put(
                topics.INSERTION,
                state.sampled_at_s,
                lambda: records.insertion_record(state, entry, self._force),
            )

    def _entry_written(self, job: Job, event: JobEvent) -> None:
        if self._session is not None and job.id == self._job_id:
            self._session.put(topics.EVENT, self._now_s(), lambda: records.event_record(event))

    def _socket_seen(self, socket: SocketPose, frame: Frame) -> None:
        session = self._session
        if session is None:
            return
        exposed_s = frame.captured_at_s
        session.put(topics.SOCKET, exposed_s, lambda: records.socket_record(socket))
        if self._pictures.takes(exposed_s):
            stamp_ns = session.stamp_ns(exposed_s)
            session.put(
                topics.PICTURE, exposed_s, lambda: records.picture_record(frame.image, stamp_ns)
            )

    def _parted(self, change: Change) -> None:
        session = self._session
        if session is None:
            return
        divergence, began = change.divergence, change.began
        report = divergence_report(divergence, self._calendar)
        session.put(
            topics.DIVERGENCE,
            self._now_s(),
            lambda: topics.DivergenceRecord(
                began=began, report=report, largest_difference=divergence.largest.difference
            ),
        )

    @staticmethod
    def _now_s() -> float:
        return asyncio.get_running_loop().time()
