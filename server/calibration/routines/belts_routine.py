"""How far the carriages really go: the robot moves them, a person measures with a rule.

One motion at constant height takes the left carriage up its rail and the right one down by the
same distance. Both ends are approached from the same side, so that play cancels. Where a
calibration of the robot is in force, its looks are solved anew with what the rule says: legs and
feet follow the new scale, rather than contradict it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.axes.estimates import Estimate, belt_scale
from server.calibration.grade import Grade
from server.calibration.robot.known_before import KnownBefore
from server.calibration.routines.known import lens_sigma_rad
from server.calibration.routines.progress import Progress
from server.calibration.routines.robot_result import result_of
from server.calibration.routines.stand import Stand
from server.calibration.versions.comparing import look_of
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.values import rotation_vector
from server.schema.calibrations import RobotEvidence, RobotValues
from server.schema.routines import BeltsRoutineRequest, RoutineInput
from twin.joints import JointPosition

Array = NDArray[np.float64]

SUM_MM, ROOM_MM = 320.0, 10.0
"""rho1 + rho2 of both ends, and how far from the end of its stroke a carriage stays."""
PLAUSIBLE = 0.05
"""A reading that is off by a larger share is a mistake."""


@dataclass(slots=True, eq=False)
class BeltsRoutine:
    """One run; after an interruption everything is measured anew: the mark may be gone.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: None: it looks at nothing.
    """

    request: BeltsRoutineRequest
    by: str
    vehicle: None = None

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Move, and ask how far that was.

        Raises:
            ControlError: the robot gave up.
            RobotCalibrationError: what was typed in does not go with the looks in force.
        """
        progress.done, progress.total = 0, 2
        progress.say("Making the robot ready.")
        await stand.make_ready()
        progress.say("Going to the first place.")
        before = await self._go(stand, -0.5 * self.request.distance_mm)
        progress.step()
        await progress.confirm(
            "belts_marked", "Mark on the rail where both carriages stand, then confirm."
        )
        progress.say("Going to the second place.")
        after = await self._go(stand, 0.5 * self.request.distance_mm)
        progress.step()
        progress.say("Waiting for what the rule says.")
        commanded_mm = np.abs(after - before)
        measured_mm = [
            await self._reading(progress, name, float(told_mm))
            for name, told_mm in zip(("left", "right"), commanded_mm, strict=True)
        ]
        left, right = (
            belt_scale(float(told), read, self.request.reading_sigma_mm)
            for told, read in zip(commanded_mm, measured_mm, strict=True)
        )
        return self._found(stand, (left, right), commanded_mm, np.array(measured_mm))

    async def _go(self, stand: Stand, away_mm: float) -> Array:
        """Both carriages there; what the board counts then, shape (2,) [mm]."""
        middle_mm = 0.5 * max(SUM_MM, self.request.distance_mm + 2 * ROOM_MM)
        slide_mm = stand.supervisor.geometry.rho3.min_mm
        await stand.go_joints(JointPosition(middle_mm + away_mm, middle_mm - away_mm, slide_mm))
        return stand.board_rho_mm

    async def _reading(self, progress: Progress, name: str, told_mm: float) -> float:
        return await progress.number(
            f"belts_{name}",
            f"How far has the {name} carriage gone from its mark?",
            RoutineInput(
                unit="mm",
                least=round((1 - PLAUSIBLE) * told_mm, 1),
                most=round((1 + PLAUSIBLE) * told_mm, 1),
            ),
        )

    def _found(
        self,
        stand: Stand,
        scales: tuple[Estimate, Estimate],
        commanded_mm: Array,
        measured_mm: Array,
    ) -> NewCalibration:
        source = (
            f"Both carriages over {self.request.distance_mm:g} mm with a rule: "
            f"{measured_mm[0]:g} and {measured_mm[1]:g} mm"
        )
        left, right = scales
        if stand.evidence is not None and stand.evidence.looks:
            known = KnownBefore(
                left_scale=left.value,
                right_scale=right.value,
                scale_sigma=max(left.sigma, right.sigma),
                lens_sigma_rad=lens_sigma_rad(stand),
            )
            looks = [look_of(record) for record in stand.evidence.looks]
            return result_of(looks, stand, known, made_by=self.by, duration_s=0.0, source=source)
        known_mechanism = stand.mechanism
        in_use = np.array([known_mechanism.left_scale, known_mechanism.right_scale])
        mechanism = known_mechanism.model_copy(
            update={"left_scale": left.value, "right_scale": right.value}
        )
        mount = stand.eye.mount.T_platform_camera[:3, :3]
        return NewCalibration(
            values=RobotValues(mechanism=mechanism, camera_rotation_rad=rotation_vector(mount)),
            made_by=self.by,
            source=source,
            grade=Grade.USABLE,
            remarks=(
                "Only the belts were measured. Measure the robot too: legs and rails are as drawn.",
            ),
            error=math.sqrt(2) * self.request.reading_sigma_mm,
            error_in_use=float(np.abs(measured_mm - in_use * commanded_mm).max()),
            evidence=RobotEvidence(
                looks=[],
                sigma={"left_scale": left.sigma, "right_scale": right.sigma},
                unseen=[],
                duration_s=0.0,
            ),
        )
