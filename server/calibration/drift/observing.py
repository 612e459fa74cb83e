"""What one job sees and feels on its way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np

from drivers.camera import Frame
from drivers.robot import BoardState, RobotState
from server.calibration.drift.belts import LookPair
from server.calibration.robot.looks import LabelLook
from server.control.force_curve import ForceCurve
from server.control.supervisor import Supervisor
from server.jobs.model import JobPhase, JobState
from server.jobs.runner import JobRunner
from server.localisation.eye import Eye
from server.localisation.frames import base_from_camera, inverse
from server.localisation.socket_pose import SocketPose
from server.schema.jobs import Job, JobEvent

FAR_ENOUGH_MM = 25.0
"""Looks from places that are nearer to each other say little of the belts."""


@dataclass(slots=True, eq=False)
class Observation:
    """Of one job.

    Attributes:
        job_id: Whose.
        looks: At the label, from standstill.
        curve: Force over depth of the newest push.
        tries: Pushes that did not go in.
        seated: The plug has gone in.
    """

    job_id: str
    looks: list[LabelLook] = field(default_factory=list)
    curve: ForceCurve = field(default_factory=ForceCurve)
    tries: int = 0
    seated: bool = False

    def pair(self, vehicle_id: str) -> LookPair | None:
        """The two looks that are furthest apart; None: none are far enough."""
        pairs = combinations(self.looks, 2)
        furthest = max(pairs, key=lambda two: _apart_mm(*two), default=None)
        if furthest is None or _apart_mm(*furthest) < FAR_ENOUGH_MM:
            return None
        return LookPair(vehicle_id, *furthest)


class JobObserver:
    """Looks on while jobs run, and hands over what each successful one has seen.

    Args:
        supervisor: Gives telemetry.
        runner: Gives jobs and their journals.
        eye: Gives what it sees.
        done: Called with each job that has plugged in, and what was observed.
    """

    def __init__(
        self,
        supervisor: Supervisor,
        runner: JobRunner,
        eye: Eye,
        done: Callable[[Job, Observation], None],
    ) -> None:
        self._supervisor = supervisor
        self._eye = eye
        self._done = done
        self._now: Observation | None = None
        self._phase: JobPhase | None = None
        self._sample: RobotState | None = None
        supervisor.listen(self._robot_changed)
        runner.listen_to_journal(self._entry)
        eye.listen(self._socket_seen)

    def _entry(self, job: Job, event: JobEvent) -> None:
        if self._now is None or self._now.job_id != job.id:
            self._now = Observation(job.id)
        self._phase = job.phase
        if event.kind == "insertion_try":
            self._now.tries += 1
            self._now.curve = ForceCurve()
        elif event.kind == "seated":
            self._now.seated = True
        if job.state is JobState.SUCCEEDED:
            observed, self._now = self._now, None
            if observed.seated:
                self._done(job, observed)

    def _socket_seen(self, socket: SocketPose, _: Frame) -> None:
        observed, board = self._now, self._supervisor.board_state
        if observed is None or observed.seated or board is None or not socket.from_standstill:
            return
        if not self._supervisor.play.from_below:
            return  # play would pass for a belt that has changed
        joints = self._supervisor.telemetry.joints_at(socket.measured_at_s)
        camera = base_from_camera(self._supervisor.geometry, self._eye.mount, joints)
        label = (inverse(camera) @ socket.T_base_label)[:3, 3]
        built = self._supervisor.built.correction
        on_board = np.array(joints)
        if built is not None:
            (on_board,) = built.to_board_many(on_board[np.newaxis])
        observed.looks.append(LabelLook(on_board[:2], label, socket.covariance))

    def _robot_changed(self) -> None:
        state, observed = self._supervisor.telemetry.latest, self._now
        if state is None or state is self._sample:
            return
        self._sample = state
        corridor = self._supervisor.plug.corridor
        pushing = state.board is BoardState.RUN and state.commanded.velocity.rho3_mm_s > 0
        if observed is None or corridor is None or observed.seated or not pushing:
            return
        if self._phase is JobPhase.INSERTING:
            depth_mm = state.measured.position.rho3_mm - corridor.face_rho3_mm
            observed.curve.add(depth_mm, state.force_n)


def _apart_mm(first: LabelLook, last: LabelLook) -> float:
    return float(np.linalg.norm(last.label_mm - first.label_mm))
