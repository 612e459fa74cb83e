"""How well the limit switches of the carriages repeat: home, look, home again.

The board counts from where a switch closed, so a switch that closes elsewhere shifts every place.
The camera sees that shift by the one label that stands still. After each homing it looks twice,
the second time after going away and coming back: what differs then is the look, not the switch.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from server.calibration.axes.carriages import Array, carriages_moved_mm
from server.calibration.axes.estimates import Estimate, spread_between
from server.calibration.axes.verdict import judge_switches
from server.calibration.robot.looks import LabelLook
from server.calibration.routines.errors import LabelLostError
from server.calibration.routines.progress import Progress
from server.calibration.routines.stand import Stand
from server.calibration.versions.new_calibration import NewCalibration
from server.schema.calibrations import SwitchesValues
from server.schema.routines import SwitchesRoutineRequest
from server.schema.vehicles import Vehicle
from twin.joints import JointPosition

LOOKS = 2
AWAY_MM = 10.0


@dataclass(slots=True, eq=False)
class SwitchesRoutine:
    """One run; after an interruption it goes on with the approaches that are left.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: Whose label.
    """

    request: SwitchesRoutineRequest
    by: str
    vehicle: Vehicle
    _joints: JointPosition | None = None
    _first: LabelLook | None = None
    _groups: list[Array] = field(default_factory=list)

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Home and look, as often as wanted.

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
        progress.total = LOOKS * self.request.approaches
        while len(self._groups) < self.request.approaches:
            number = len(self._groups) + 1
            progress.done = LOOKS * len(self._groups)
            progress.say(f"Homing, {number} of {self.request.approaches}.")
            await stand.supervisor.home(stand.lease)
            self._groups.append(await self._looks(stand, progress, self._joints, self._first))
        return self._found(np.stack(self._groups))

    async def _looks(
        self, stand: Stand, progress: Progress, joints: JointPosition, first: LabelLook
    ) -> Array:
        """Where the carriages stand beside the first look, shape (LOOKS, 2) [mm]."""
        found = []
        for _ in range(LOOKS):
            await stand.go_joints(joints, run_up_mm=-AWAY_MM)
            look = await stand.look()
            x_mm, y_mm = stand.platform_mm.tolist()
            progress.looked(x_mm, y_mm, seen=look is not None)
            if look is None:
                raise LabelLostError("After homing the label is not to be seen any more.")
            found.append(carriages_moved_mm(stand.mechanism, stand.R_base_camera, first, look))
        return np.stack(found)

    def _found(self, groups_mm: Array) -> NewCalibration:
        left, right = (spread_between(groups_mm[:, :, axis]) for axis in (0, 1))
        grade, remarks = judge_switches({"left": left, "right": right})
        return NewCalibration(
            values=_values(left, right, len(groups_mm)),
            made_by=self.by,
            source=f"{len(groups_mm)} homings before the label of {self.vehicle.name}"[:200],
            grade=grade,
            remarks=remarks,
            error=max(left.sigma, right.sigma),
        )


def _values(left: Estimate, right: Estimate, approaches: int) -> SwitchesValues:
    return SwitchesValues(
        left_spread_mm=left.value,
        left_sigma_mm=left.sigma,
        right_spread_mm=right.value,
        right_sigma_mm=right.sigma,
        approaches=approaches,
    )
