"""Runs the model beside the robot and says where they part."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import partial

from twin.divergence.alarm import Alarm
from twin.divergence.findings import Change, Divergence, Place, Quantity, Residual
from twin.divergence.insertion_force import InsertionForce
from twin.divergence.numbers import DivergenceNumbers
from twin.divergence.phase_clock import PhaseClock
from twin.divergence.plan_line import PlanLine
from twin.divergence.samples import Entry, Sample, Sighting
from twin.divergence.socket_place import SocketPlace
from twin.divergence.tracking import Tracking
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import KinematicsError, gamma
from twin.motion.segments import Segment
from twin.slide_pace import SlidePace

_JOINTS = {Quantity.RHO1: 0, Quantity.RHO2: 1, Quantity.RHO3: 2}


class DivergenceWatch:
    """One robot, its model and the alarms between them.

    Args:
        geometry: Of the robot.
        numbers: What the model expects.
    """

    def __init__(self, geometry: RobotGeometry, numbers: DivergenceNumbers) -> None:
        self.entry: Entry | None = None
        self._geometry = geometry
        self._tracking = Tracking(numbers.tracking)
        self._plan = PlanLine(numbers.set_point)
        self._force = InsertionForce(numbers.force)
        self._pace = SlidePace()
        self._clock = PhaseClock(numbers.time)
        self._socket = SocketPlace(geometry, numbers.socket)
        self._alarms = {
            quantity: Alarm(
                numbers.alarm, 1 if quantity is Quantity.SOCKET else numbers.alarm.raise_samples
            )
            for quantity in Quantity
        }

    @property
    def parted(self) -> tuple[Divergence, ...]:
        """All alarms that are on."""
        alarms = (alarm.divergence for alarm in self._alarms.values())
        return tuple(divergence for divergence in alarms if divergence is not None)

    def begin_job(self) -> list[Change]:
        """Another job begins: what was found in the last one is over."""
        self._socket.forget()
        return self._end(Quantity)

    def begin_phase(self, phase: str, now_s: float) -> list[Change]:
        """A phase of the job begins; an empty name ends the last one."""
        self._clock.begin(phase, now_s, self._plan.sent_s)
        return self._end([Quantity.PHASE_TIME])

    def take_segments(self, segments: Sequence[Segment], now_s: float) -> None:
        """Segments were sent to the board now."""
        self._plan.append(segments, now_s)

    def take_sample(self, sample: Sample) -> list[Change]:
        """Compare one telemetry sample."""
        residuals = [self._clock.compare(sample.at_s, self._plan.sent_s)]
        if sample.following:
            residuals += self._tracking.compare(sample)
            residuals.append(self._compare_force(sample))
            residuals.append(self._plan.compare(sample) if sample.running else None)
        else:
            self._tracking.reset()
            self._pace.reset()
            self._plan.drop()
        return self._judge(residuals, sample.at_s, sample.measured)

    def take_sighting(self, sighting: Sighting) -> list[Change]:
        """Compare one sighting of the socket."""
        residual = self._socket.compare(sighting)
        return self._judge([residual], sighting.at_s, sighting.joints)

    def _compare_force(self, sample: Sample) -> Residual | None:
        """The comparison; None while the motor may be all that it shows, or contact is unknown."""
        speed_mm_s = sample.velocity.rho3_mm_s
        self._pace.take(sample.at_s, sample.commanded.rho3_mm, speed_mm_s, sample.measured.rho3_mm)
        residual = self._force.compare(sample, self.entry) if sample.contact_known else None
        if residual is not None:
            against = residual.difference * speed_mm_s > 0
            if self._pace.shows_too_much if against else self._pace.shows_too_little:
                return residual
        self._alarms[Quantity.FORCE].interrupt()
        return None

    def _judge(
        self, residuals: Iterable[Residual | None], at_s: float, joints: JointPosition
    ) -> list[Change]:
        changes = []
        for residual in residuals:
            if residual is not None:
                place = partial(self._place, residual, at_s, joints)
                changes.append(self._alarms[residual.quantity].take(residual, at_s, place))
        return [change for change in changes if change is not None]

    def _end(self, quantities: Iterable[Quantity]) -> list[Change]:
        changes = (self._alarms[quantity].end() for quantity in quantities)
        return [change for change in changes if change is not None]

    def _place(self, residual: Residual, at_s: float, joints: JointPosition) -> Place:
        return Place(
            at_s=at_s,
            phase=self._clock.phase,
            joints=joints,
            depth_mm=None if self.entry is None else joints.rho3_mm - self.entry.face_rho3_mm,
            tip_off_mm=self._tip_off_mm(residual, joints),
        )

    def _tip_off_mm(self, residual: Residual, joints: JointPosition) -> float | None:
        """How far a joint's difference moves the plug's tip, by the kinematics."""
        joint = _JOINTS.get(residual.quantity)
        if joint is None:
            return None
        expected = list(joints)
        expected[joint] = residual.expected
        try:
            return math.dist(
                gamma.forward(self._geometry, JointPosition(*expected)),
                gamma.forward(self._geometry, joints),
            )
        except KinematicsError:
            return None
