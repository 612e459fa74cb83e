"""Feeds the model with what the robot reports, and notes in the job's journal what it finds."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence

from drivers.camera import Frame
from drivers.robot import BoardState, RobotState
from server.control.model import PlugState
from server.control.supervisor import Supervisor
from server.jobs.model import JobState
from server.jobs.runner import JobRunner
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.storage.errors import StorageError
from twin.divergence import (
    Change,
    Divergence,
    DivergenceNumbers,
    DivergenceWatch,
    Entry,
    Sample,
    Sighting,
)
from twin.divergence.words import sentence, title
from twin.motion.segments import Segment

_log = logging.getLogger(__name__)

Listener = Callable[[Change], None]


class DivergenceWatcher:
    """Runs the model beside one robot for as long as PlugPilot runs.

    It only looks on: nothing it finds stops the robot, and nothing it does holds the robot up.

    Args:
        supervisor: Gives telemetry and the segments that were sent.
        runner: Gives the phases; takes the entries of the journal.
        eye: Gives the sightings of the socket.
        numbers: What the model expects.
    """

    def __init__(
        self, supervisor: Supervisor, runner: JobRunner, eye: Eye, numbers: DivergenceNumbers
    ) -> None:
        self._supervisor = supervisor
        self._runner = runner
        self._watch = DivergenceWatch(supervisor.geometry, numbers)
        self._listeners: list[Listener] = []
        self._notes: set[asyncio.Task[None]] = set()
        self._seen: RobotState | None = None
        self._job_id = ""
        self._phase = ""
        supervisor.listen(self._robot_changed)
        supervisor.listen_to_segments(self._segments_sent)
        runner.listen(self._job_changed)
        eye.listen(self._socket_seen)

    @property
    def parted(self) -> tuple[Divergence, ...]:
        """What differs now by more than its uncertainty."""
        return self._watch.parted

    def listen(self, listener: Listener) -> None:
        """Call ``listener`` whenever model and robot part or agree again."""
        self._listeners.append(listener)

    async def close(self) -> None:
        """Finish writing what was found."""
        if self._notes:
            await asyncio.wait(self._notes)

    def _robot_changed(self) -> None:
        state = self._supervisor.telemetry.latest
        if state is None or state is self._seen:
            return
        self._seen = state
        self._watch.entry = self._entry()
        self._spread(self._watch.take_sample(self._sample(state)))

    def _segments_sent(self, segments: Sequence[Segment]) -> None:
        self._watch.take_segments(segments, asyncio.get_running_loop().time())

    def _job_changed(self) -> None:
        job = self._runner.newest
        if job is None:
            return
        if job.id != self._job_id and job.state is JobState.RUNNING:
            self._job_id = job.id
            self._spread(self._watch.begin_job())
        phase = "" if job.state.ended else job.phase.value
        if phase != self._phase:
            self._phase = phase
            now_s = asyncio.get_running_loop().time()
            self._spread(self._watch.begin_phase(phase, now_s))

    def _socket_seen(self, socket: SocketPose, frame: Frame) -> None:
        if not socket.from_standstill:
            return  # its covariance leaves out what the motion does to the picture
        sighting = Sighting(
            at_s=frame.captured_at_s,
            place_mm=socket.T_base_socket[:3, 3],
            covariance_mm2=socket.covariance,
            joints=self._supervisor.telemetry.joints_at(frame.captured_at_s),
        )
        self._spread(self._watch.take_sighting(sighting))

    def _entry(self) -> Entry | None:
        corridor, socket = self._supervisor.plug.corridor, self._runner.socket
        if corridor is None:
            return None
        sigma_mm = socket.depth_sigma_mm if socket is not None else 0.0
        return Entry(corridor.face_rho3_mm, sigma_mm)

    def _sample(self, state: RobotState) -> Sample:
        follows = state.board in {BoardState.READY, BoardState.RUN}
        return Sample(
            at_s=state.sampled_at_s,
            measured=state.measured.position,
            commanded=state.commanded.position,
            velocity=state.commanded.velocity,
            force_n=state.force_n,
            following=follows and state.homed and state.enabled,
            running=state.board is BoardState.RUN,
            contact_known=self._contact_known(),
        )

    def _contact_known(self) -> bool:
        """Not of a lost plug, nor while somebody calibrates: with a spring before it, for one."""
        holder = self._supervisor.holder
        calibrates = holder is not None and holder.kind == "calibration"
        return self._supervisor.plug.state is not PlugState.UNKNOWN and not calibrates

    def _spread(self, changes: Sequence[Change]) -> None:
        for change in changes:
            _log.warning(
                "%s: %s",
                "robot and model part" if change.began else "robot and model agree again",
                sentence(change.divergence),
            )
            for listener in self._listeners:
                listener(change)
            task = asyncio.create_task(self._note(change), name="note of a divergence")
            self._notes.add(task)
            task.add_done_callback(self._notes.discard)

    async def _note(self, change: Change) -> None:
        divergence = change.divergence
        residual, place = divergence.residual, divergence.place
        kind = "divergence" if change.began else "divergence_over"
        try:
            await self._runner.note(
                kind,
                f"{title(divergence.quantity)}. {sentence(divergence)}"
                if change.began
                else f"{title(divergence.quantity)}: that is over. The largest difference was "
                f"{abs(divergence.largest.difference):.2f} {residual.unit}.",
                quantity=residual.quantity.value,
                unit=residual.unit,
                measured=round(residual.measured, 4),
                expected=round(residual.expected, 4),
                sigma=round(residual.sigma, 4),
                sigmas=round(residual.sigmas, 1),
                largest=round(divergence.largest.difference, 4),
                rho1_mm=round(place.joints.rho1_mm, 3),
                rho2_mm=round(place.joints.rho2_mm, 3),
                rho3_mm=round(place.joints.rho3_mm, 3),
                depth_mm=_rounded(place.depth_mm),
                tip_off_mm=_rounded(place.tip_off_mm),
            )
        except StorageError as error:
            _log.warning("a divergence could not be written into the journal: %s", error)


def _rounded(value_mm: float | None) -> float | None:
    return None if value_mm is None else round(value_mm, 3)
