"""What the picture shows: one instant of the robot, the plug and the car."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from twin.joints import JointPosition

Pose = NDArray[np.float64]
"""Homogeneous transform, shape (4, 4), translation in mm. T_a_b maps b coordinates to a."""

PlugPlace = Literal["parked", "free", "inserted", "unknown"]


@dataclass(frozen=True, slots=True)
class PlannedPath:
    """Where the plug's tip goes while a plan is followed.

    Attributes:
        times_s: Seconds after the plan's start, ascending from 0, shape (N,), N >= 2.
        tips_mm: Tip at these times in the base frame, shape (N, 3).
    """

    times_s: NDArray[np.float64]
    tips_mm: NDArray[np.float64]

    @property
    def duration_s(self) -> float:
        """Length of the plan."""
        return float(self.times_s[-1])


@dataclass(frozen=True, slots=True)
class ChosenTarget:
    """A place that somebody has chosen; the robot goes there only when it is told to.

    Attributes:
        joints: Joint positions there.
        path: The way of the plug's tip.
    """

    joints: JointPosition
    path: PlannedPath


@dataclass(frozen=True, slots=True, kw_only=True)
class TwinState:
    """Plain values, so that the scene needs to know neither drivers nor jobs.

    Attributes:
        measured: Joint positions that the robot reports, None while it does not know them.
        commanded: Joint positions that it was told to be at, None when there is no command.
        force_n: Force on the plug along the insertion axis [N], positive when it is pushed back.
        plug: Where the plug is.
        mode: The robot's mode in one word; shown as it is.
        charging: Whether energy flows into the car.
        T_base_socket: Measured pose of the socket (origin the centre of its face, z into the
            car); None shows the car faded at its nominal place.
        T_base_label: Measured pose of the QR label (origin its centre, x right, y down, z into
            the car); None shows it at its nominal place beside the socket.
        socket_covariance_mm2: Of the socket's origin in the base frame, shape (3, 3); None while
            it was not measured.
        parted: Quantities in which robot and model have parted, as `twin.divergence.Quantity`.
        path: The plan being followed, None while there is none. The same object as long as it
            is the same plan.
        target: Where somebody wants the robot to go, None if nobody does. The same object as long
            as it is the same target.
    """

    measured: JointPosition | None = None
    commanded: JointPosition | None = None
    force_n: float = 0.0
    plug: PlugPlace = "unknown"
    mode: str = ""
    charging: bool = False
    T_base_socket: Pose | None = None
    T_base_label: Pose | None = None
    socket_covariance_mm2: NDArray[np.float64] | None = None
    parted: tuple[str, ...] = ()
    path: PlannedPath | None = None
    target: ChosenTarget | None = None
