"""A motion of the drawn robot as a motion of the built one's joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twin.as_built.correction import JointCorrection
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.plan import JointState, MotionPlan, MotionSamples, ReadByState

Array = NDArray[np.float64]

_DIFFERENCE_S = 1e-4
"""For how the rates change along the way; they hardly do, so a difference is exact enough."""


@dataclass(frozen=True, slots=True)
class CorrectedPlan(ReadByState):
    """What the board must do while the drawn robot would follow a plan. Itself a MotionPlan.

    Attributes:
        plan: In joints of the drawing.
        correction: To those of the board.
    """

    plan: MotionPlan
    correction: JointCorrection

    @property
    def duration_s(self) -> float:
        """As long as the plan itself [s]."""
        return self.plan.duration_s

    @property
    def start(self) -> JointState:
        """State of the board's joints at time 0."""
        return self._mapped(self.plan.start)

    @property
    def end(self) -> JointState:
        """State of the board's joints at `duration_s`."""
        return self._mapped(self.plan.end)

    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations of the board's joints."""
        return self._mapped(self.plan.state_at(t_s))

    def sample(self, times_s: Array) -> MotionSamples:
        """The board's joints at many times, shape (N,) [s]."""
        drawn = self.plan.sample(times_s)
        return self._mapped_many(drawn)

    def _mapped(self, state: JointState) -> JointState:
        one = MotionSamples(
            np.array([state.position]), np.array([state.velocity]), np.array([state.acceleration])
        )
        board = self._mapped_many(one)
        return JointState(
            JointPosition(*board.position_mm[0].tolist()),
            JointVelocity(*board.velocity_mm_s[0].tolist()),
            JointAcceleration(*board.acceleration_mm_s2[0].tolist()),
        )

    def _mapped_many(self, drawn: MotionSamples) -> MotionSamples:
        """With M the rates: q_b' = M q',   q_b'' = M q'' + M' q'."""
        rates = self.correction.rates_many(drawn.position_mm)
        ahead_mm = _DIFFERENCE_S * drawn.velocity_mm_s
        change = self.correction.rates_many(drawn.position_mm + ahead_mm)
        change = (change - self.correction.rates_many(drawn.position_mm - ahead_mm)) / (
            2 * _DIFFERENCE_S
        )
        return MotionSamples(
            self.correction.to_board_many(drawn.position_mm),
            _times(rates, drawn.velocity_mm_s),
            _times(rates, drawn.acceleration_mm_s2) + _times(change, drawn.velocity_mm_s),
        )


def _times(matrices: Array, vectors: Array) -> Array:
    return np.asarray(np.einsum("nij,nj->ni", matrices, vectors))
