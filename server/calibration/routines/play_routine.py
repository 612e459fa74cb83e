"""Play of each carriage, from reversals: the same place from both sides, seen by the camera."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from server.calibration.axes.carriages import Array, carriages_moved_mm
from server.calibration.axes.estimates import play
from server.calibration.axes.following import FollowingWatch
from server.calibration.axes.verdict import judge_play
from server.calibration.robot.looks import LabelLook
from server.calibration.routines.errors import LabelLostError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.schema.calibrations import PlayValues
from server.schema.routines import PlayRoutineRequest
from server.schema.vehicles import Vehicle
from twin.joints import JointPosition

CARRIAGES = ("left", "right")
BELOW, ABOVE = -1.0, 1.0
RUN_UP_MM = 5.0
"""More than any play."""


@dataclass(slots=True, eq=False)
class PlayRoutine:
    """One run; after an interruption it goes on with the approaches that are left.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: Whose label.
    """

    request: PlayRoutineRequest
    by: str
    vehicle: Vehicle
    _joints: JointPosition | None = None
    _first: LabelLook | None = None
    _stood_mm: dict[tuple[int, float], list[float]] = field(default_factory=dict)
    _following: FollowingWatch = field(default_factory=FollowingWatch)

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Approach the place with each carriage from both sides, and look.

        Raises:
            LabelLostError: the label went out of sight.
            ControlError, CameraDownError: the robot or the camera gave up.
        """
        progress.say("Making the robot ready.")
        await stand.make_ready()
        if self._first is None or self._joints is None:
            progress.say("Looking for the label.")
            self._first = await stand.find_label()
            self._joints = stand.supervisor.telemetry.require().commanded.position
        progress.total = len(CARRIAGES) * 2 * self.request.approaches
        progress.done = sum(len(stood) for stood in self._stood_mm.values())
        for axis, side in product(range(len(CARRIAGES)), (BELOW, ABOVE)):
            stood = self._stood_mm.setdefault((axis, side), [])
            progress.say(
                f"Bringing the {CARRIAGES[axis]} carriage to the same place from "
                f"{'below' if side == BELOW else 'above'}."
            )
            while len(stood) < self.request.approaches:
                await self._approach(stand, self._joints, axis, side)
                moved = await self._look(stand, progress, self._first)
                stood.append(float(moved[axis]))
        return self._found(stand)

    async def _approach(self, stand: Stand, joints: JointPosition, axis: int, side: float) -> None:
        """Both carriages from below first, then the one of interest by itself."""
        supervisor, lease = stand.supervisor, stand.lease
        here = list(joints)
        here[axis] += side * RUN_UP_MM
        await stand.go_joints(JointPosition(*here))
        await supervisor.move_joints(lease, joints, self._following.take)

    async def _look(self, stand: Stand, progress: Progress, first: LabelLook) -> Array:
        look = await stand.look()
        x_mm, y_mm = stand.platform_mm.tolist()
        progress.looked(x_mm, y_mm, seen=look is not None)
        if look is None:
            raise LabelLostError("From this place the label is not to be seen any more.")
        return carriages_moved_mm(stand.mechanism, stand.R_base_camera, first, look)

    def _found(self, stand: Stand) -> NewCalibration:
        sides = {key: np.array(stood) for key, stood in self._stood_mm.items()}
        found = {
            name: play(sides[axis, BELOW], sides[axis, ABOVE])
            for axis, name in enumerate(CARRIAGES)
        }
        following = dict(zip(CARRIAGES, self._following.largest_mm[:2], strict=True))
        grade, remarks = judge_play(found, following)
        left, right = (found[name] for name in CARRIAGES)
        return NewCalibration(
            values=PlayValues(
                left_mm=left.value,
                left_sigma_mm=left.sigma,
                right_mm=right.value,
                right_sigma_mm=right.sigma,
                left_following_mm=following["left"],
                right_following_mm=following["right"],
            ),
            made_by=self.by,
            source=f"{len(sides) * self.request.approaches} reversals before the label of "
            f"{self.vehicle.name}"[:200],
            grade=grade,
            remarks=remarks,
            error=_misses_mm(sides, [left.value, right.value]),
            error_in_use=_misses_mm(sides, _in_use(stand)),
        )


def _in_use(stand: Stand) -> list[float]:
    known = stand.in_force.play
    return [known.left_mm, known.right_mm] if known else [0.0, 0.0]


def _misses_mm(sides: dict[tuple[int, float], Array], play_mm: list[float]) -> float:
    """Root mean square of what each look is beside the middle of both sides and the play."""
    off = []
    for axis, width_mm in enumerate(play_mm):
        middle = 0.5 * (sides[axis, BELOW].mean() + sides[axis, ABOVE].mean())
        off += [sides[axis, side] - middle - 0.5 * side * width_mm for side in (BELOW, ABOVE)]
    return float(np.sqrt(np.mean(np.concatenate(off) ** 2)))
