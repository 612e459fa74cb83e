"""The nine-point check: places all over the regular box, approached again and again from two sides.

The camera measures where the platform came to, by the one label that stands still. Where the label
is, and how the camera is turned in the picture's plane, suits the commanded places best; what is
left is the robot's own error, lengthwise and crosswise, and not a shift of everything.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from server.calibration.accuracy.iso9283 import place_result
from server.calibration.routines.errors import LabelLostError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.control.errors import ActuatorOverloadError, MotionOutOfReachError
from server.schema.accuracy import CheckedPlace
from server.schema.routines import CheckRoutineRequest
from server.schema.vehicles import Vehicle
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

FEWEST_PLACES = 4
RUN_UP_MM = 5.0
"""From so far away each place is approached: more than any play."""

BELOW, ABOVE = -1, 1


@dataclass(frozen=True, slots=True)
class CheckResult:
    """What a check has found.

    Attributes:
        request: What was asked for.
        by: Who asked.
        places: Those with a label in the picture.
        left_out: How many had none.
        duration_s: Robot time.
    """

    request: CheckRoutineRequest
    by: str
    places: tuple[CheckedPlace, ...]
    left_out: int
    duration_s: float


@dataclass(slots=True, eq=False)
class CheckRoutine:
    """One run; after an interruption it goes on with the places that are left.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: Whose label.
    """

    request: CheckRoutineRequest
    by: str
    vehicle: Vehicle
    _left: list[Array] | None = None
    _seen: list[tuple[Array, Array]] = field(default_factory=list)
    _spent_s: float = 0.0

    async def run(self, stand: Stand, progress: Progress) -> CheckResult:
        """Approach every place, and say how well the robot came there.

        Raises:
            LabelLostError: too few places show the label.
            ControlError, CameraDownError: the robot or the camera gave up.
        """
        loop = asyncio.get_running_loop()
        began_s = loop.time()
        try:
            progress.say("Making the robot ready.")
            await stand.make_ready()
            if self._left is None:
                self._left = nine_places(stand.supervisor.geometry)
                progress.total = len(self._left)
            await self._collect(stand, progress, self._left)
        finally:
            self._spent_s += loop.time() - began_s
        left_out = progress.total - len(self._seen)
        if len(self._seen) < FEWEST_PLACES:
            raise LabelLostError(
                f"The label was to be seen from {len(self._seen)} of {progress.total} places; "
                f"{FEWEST_PLACES} are needed. Let the car stand in the middle of the box."
            )
        rotation = stand.R_base_camera
        return CheckResult(
            self.request, self.by, judged(self._seen, rotation), left_out, self._spent_s
        )

    async def _collect(self, stand: Stand, progress: Progress, left: list[Array]) -> None:
        progress.say("Approaching each place from both sides.")
        while left:
            labels = await self._place(stand, left[0])
            place = left.pop(0)
            if labels is not None:
                self._seen.append((place, labels))
            progress.looked(float(place[0]), float(place[1]), seen=labels is not None)

    async def _place(self, stand: Stand, place_mm: Array) -> Array | None:
        """What the camera saw, shape (2, approaches, 3); None where the label is not to be seen."""
        seen = np.empty((2, self.request.approaches, 3))
        for side, from_side in enumerate((BELOW, ABOVE)):
            for approach in range(self.request.approaches):
                try:
                    await stand.go(place_mm, from_side * RUN_UP_MM)
                except (MotionOutOfReachError, ActuatorOverloadError):
                    return None
                look = await stand.look()
                if look is None:
                    return None
                seen[side, approach] = look.label_mm
        return seen


def nine_places(geometry: RobotGeometry) -> list[Array]:
    """Middle, corners and middles of the edges of the regular box, line by line, of V [mm]."""
    box = geometry.regular_box
    x_mm = box.center_x_mm + 0.5 * box.width_mm * np.array([-1.0, 0.0, 1.0])
    y_mm = box.center_y_mm + 0.5 * box.height_mm * np.array([-1.0, 0.0, 1.0])
    there, back = x_mm.tolist(), x_mm[::-1].tolist()
    return [
        np.array([x, y])
        for line, y in enumerate(y_mm.tolist())
        for x in (back if line % 2 else there)
    ]


def judged(seen: list[tuple[Array, Array]], R_base_camera: Array) -> tuple[CheckedPlace, ...]:
    """AP, RP and vAP of each place.

    Args:
        seen: Where the platform was sent, shape (2,), and what was seen there, shape (2, n, 3).
        R_base_camera: How the camera is turned, shape (3, 3).
    """
    commanded = np.stack([place for place, _ in seen])
    labels = np.stack([labels for _, labels in seen])
    by_looks = -(labels @ R_base_camera.T)[..., :2]
    attained = _shifted_and_turned(by_looks, commanded)
    found = []
    for place, (below, above) in zip(commanded, attained, strict=True):
        result = place_result(place, {"below": below, "above": above})
        found.append(
            CheckedPlace(
                x_mm=float(place[0]),
                y_mm=float(place[1]),
                accuracy_mm=result.accuracy_mm,
                repeatability_mm=result.repeatability_mm,
                direction_variation_mm=result.direction_variation_mm,
                attained_mm=[(float(x), float(y)) for x, y in (*below, *above)],
            )
        )
    return tuple(found)


def _shifted_and_turned(by_looks: Array, commanded: Array) -> Array:
    """Looks as places of the platform: the rigid motion that suits best (Kabsch 1976)."""
    means = by_looks.mean(axis=(1, 2))
    here, there = commanded - commanded.mean(axis=0), means - means.mean(axis=0)
    left, _, right = np.linalg.svd(there.T @ here)
    turn = right.T @ np.diag([1.0, np.linalg.det(right.T @ left.T)]) @ left.T
    moved: Array = (by_looks - means.mean(axis=0)) @ turn.T + commanded.mean(axis=0)
    return moved
