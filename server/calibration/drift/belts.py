"""How the belts change, from the looks of jobs: a Kalman filter (Kalman 1960).

A job sees a label that stands still from two places a and b. With V the platform, R the camera's
attitude, o a look and s the label's true size over the entered one,

    V_b - V_a + s R (o_b - o_a) = 0.

What is left of that with the robot as it was measured and s = 1 is a shift of the label that never
happened. Belts that have become longer explain it, to first order, by -(B_b - B_a) d with B the
derivatives of V, and a label of another size by -(s - 1) R (o_b - o_a). A label never changes its
size, belts do: only they get process noise. So what was wrong from the beginning goes to the label
and what changes goes to the belts. Where the label itself is drops out, so that a car that parks
elsewhere, or a label that was stuck on anew, teaches nothing wrong.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from server.calibration.robot.looks import LabelLook
from twin.as_built import PlanarAsBuilt

Array = NDArray[np.float64]

LOOK_SIGMA_MM = 0.04
"""Of one look across the picture: the picture, where the robot comes to rest, the lens."""
SCALE_SIGMA = 4e-4
"""Of each belt after it was measured."""
RATIO_SIGMA = 2.5e-3
"""Of a label's size, before it was seen in a job."""
STEP_SIGMA = 4e-5
"""By so much a belt may change from one job to the next."""
GATE = 13.8
"""Squared length of two whitened numbers that 0.1 % of honest jobs exceed."""
BOUND = 4e-3
"""Further than that nothing is learnt from jobs: then the robot has to be measured."""
RECENT = 20
_SCALES = slice(8, 10)


@dataclass(frozen=True, slots=True, eq=False)
class LookPair:
    """Two looks of one job at one label.

    Attributes:
        vehicle_id: Whose label.
        first: A look.
        last: Another, from elsewhere.
    """

    vehicle_id: str
    first: LabelLook
    last: LabelLook


class SeenShift(BaseModel):
    """What one job left over: ``shift_mm`` = ``by_belts`` d + ``by_label_mm`` (s - 1) + noise."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    vehicle_id: str
    shift_mm: tuple[float, float]
    by_belts_mm: tuple[tuple[float, float], tuple[float, float]]
    by_label_mm: tuple[float, float]


class BeltMemory(BaseModel):
    """All that the filter knows.

    Attributes:
        vehicles: Whose labels have been seen, in the order of the state.
        state: Change of the left and of the right belt, then s - 1 of each label.
        covariance: Of the state, row by row.
        jobs: That were learnt from.
        refused_in_a_row: Jobs whose looks did not fit at all, since the last that did.
        recent: The last shifts.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    vehicles: tuple[str, ...] = ()
    state: tuple[float, ...] = (0.0, 0.0)
    covariance: tuple[tuple[float, ...], ...] = ((SCALE_SIGMA**2, 0.0), (0.0, SCALE_SIGMA**2))
    jobs: int = Field(0, ge=0)
    refused_in_a_row: int = Field(0, ge=0)
    recent: tuple[SeenShift, ...] = ()

    @property
    def belts(self) -> Array:
        """Change of both belts, as a share, shape (2,)."""
        return np.array(self.state[:2])

    @property
    def belts_sigma(self) -> Array:
        """Standard deviations of that, shape (2,)."""
        return np.sqrt(np.diag(np.array(self.covariance))[:2])

    @property
    def at_bound(self) -> bool:
        """As much was learnt as may be."""
        return bool(np.any(np.abs(self.belts) >= BOUND))

    def corrected(self, measured: PlanarAsBuilt) -> PlanarAsBuilt:
        """The robot with its belts as they are now."""
        left, right = self.state[:2]
        return measured.model_copy(
            update={
                "left_scale": measured.left_scale + left,
                "right_scale": measured.right_scale + right,
            }
        )

    def learn(self, seen: SeenShift) -> BeltMemory:
        """After one more job; looks that do not fit at all teach nothing."""
        memory = self if seen.vehicle_id in self.vehicles else self._with_label(seen.vehicle_id)
        label = 2 + memory.vehicles.index(seen.vehicle_id)
        state, covariance = np.array(memory.state), np.array(memory.covariance)
        covariance[:2, :2] += STEP_SIGMA**2 * np.eye(2)
        design = np.zeros((2, len(state)))
        design[:, :2] = seen.by_belts_mm
        design[:, label] = seen.by_label_mm
        of_shift = design @ covariance @ design.T + 2 * LOOK_SIGMA_MM**2 * np.eye(2)
        surprise = np.array(seen.shift_mm) - design @ state
        if float(surprise @ np.linalg.solve(of_shift, surprise)) > GATE:
            return self.model_copy(update={"refused_in_a_row": self.refused_in_a_row + 1})
        gain = np.linalg.solve(of_shift, design @ covariance).T
        state = state + gain @ surprise
        state[:2] = np.clip(state[:2], -BOUND, BOUND)
        rest = np.eye(len(state)) - gain @ design
        noise = 2 * LOOK_SIGMA_MM**2 * gain @ gain.T
        covariance = rest @ covariance @ rest.T + noise
        return memory.model_copy(
            update={
                "state": tuple(state.tolist()),
                "covariance": tuple(tuple(row) for row in covariance.tolist()),
                "jobs": memory.jobs + 1,
                "refused_in_a_row": 0,
                "recent": (*memory.recent, seen)[-RECENT:],
            }
        )

    def misses_mm(self, belts: Array) -> float | None:
        """What the last jobs are off if the belts had changed like this, root mean square."""
        if not self.recent:
            return None
        squares = []
        for seen in self.recent:
            ratio = self.state[2 + self.vehicles.index(seen.vehicle_id)]
            off = np.array(seen.shift_mm) - np.array(seen.by_belts_mm) @ belts
            squares.append(float(np.sum((off - np.array(seen.by_label_mm) * ratio) ** 2)))
        return float(np.sqrt(np.mean(squares)))

    def _with_label(self, vehicle_id: str) -> BeltMemory:
        size = len(self.state)
        covariance = np.zeros((size + 1, size + 1))
        covariance[:size, :size] = self.covariance
        covariance[size, size] = RATIO_SIGMA**2
        return self.model_copy(
            update={
                "vehicles": (*self.vehicles, vehicle_id),
                "state": (*self.state, 0.0),
                "covariance": tuple(tuple(row) for row in covariance.tolist()),
            }
        )


def seen_shift(measured: PlanarAsBuilt, R_base_camera: Array, pair: LookPair) -> SeenShift:
    """What two looks leave over, with the robot as it was measured.

    Args:
        measured: The mechanism.
        R_base_camera: How the camera is turned, shape (3, 3).
        pair: The looks.
    """
    rho = np.stack([pair.first.rho_mm, pair.last.rho_mm])
    platform = measured.forward_many(rho)
    by_scale = measured.derivatives_many(rho, platform)[:, :, _SCALES]
    label = (R_base_camera @ (pair.last.label_mm - pair.first.label_mm))[:2]
    shift = platform[1] - platform[0] + label
    (a, b), (c, d) = (by_scale[0] - by_scale[1]).tolist()
    return SeenShift(
        vehicle_id=pair.vehicle_id,
        shift_mm=(float(shift[0]), float(shift[1])),
        by_belts_mm=((a, b), (c, d)),
        by_label_mm=(float(-label[0]), float(-label[1])),
    )
