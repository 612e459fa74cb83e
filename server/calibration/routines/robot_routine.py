"""The robot as it was built, from looks at one label out of 25 poses at most.

Where the label is found, two looks, each with one carriage moved by itself, show that the motors
are connected as they should be. The next has the label in the middle of the picture. Twenty follow
from the places that tell most, and the last is from the middle again: the label must be where it
was.

Every pose counts from where the label is found, also one without the label and a repeated one; for
each of them there is one place less among those that tell most.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from typing import Self

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.looks import LabelLook
from server.calibration.routines.errors import LabelLostError, LabelMovedError
from server.calibration.routines.known import known_before, lens_sigma_rad
from server.calibration.routines.progress import Progress
from server.calibration.routines.robot_memory import KeptLook, RobotMemory
from server.calibration.routines.robot_places import FirstLook, next_places
from server.calibration.routines.robot_result import result_of
from server.calibration.routines.stand import Stand
from server.calibration.routines.wiring import check_wiring
from server.calibration.versions.new_calibration import NewCalibration
from server.control.errors import ActuatorOverloadError, MotionOutOfReachError
from server.schema.routines import RobotRoutineRequest
from server.schema.vehicles import Vehicle
from twin.as_built import PlanarAsBuilt
from twin.joints import JointPosition

Array = NDArray[np.float64]

WIRING_STEP_MM = 12.0
POSES = 25
"""At most, from where the label is found to the middle again."""
FEWEST_LOOKS = 16
MOVED_MM = 0.25
"""A label that is off by more than this has moved: the robot comes back to 0.1 mm at worst."""


@dataclass(slots=True, eq=False)
class RobotRoutine:
    """One run; after an interruption, a restart too, it goes on with the places that are left.

    Attributes:
        request: What was asked for.
        by: Who asked.
        vehicle: Whose label.
    """

    request: RobotRoutineRequest
    by: str
    vehicle: Vehicle
    _first: FirstLook | None = None
    _looks: list[LabelLook] = field(default_factory=list)
    _left: list[JointPosition] | None = None
    _spent_s: float = 0.0

    @classmethod
    def recalled(cls, memory: RobotMemory, by: str, vehicle: Vehicle) -> Self:
        """A routine that a restart has interrupted: it goes on with the places that are left."""
        return cls(
            memory.request,
            by,
            vehicle,
            FirstLook(memory.stood_at, np.array(memory.platform_mm), memory.first.look),
            [kept.look for kept in memory.looks],
            list(memory.left),
            memory.spent_s,
        )

    async def run(self, stand: Stand, progress: Progress) -> NewCalibration:
        """Collect what is missing, solve and judge.

        Raises:
            LabelMovedError, LabelLostError, AxesSwappedError, MotorReversedError: what was found.
            RobotCalibrationError: no robot like this could have seen the label so.
            ControlError, CameraDownError: the robot or the camera gave up.
        """
        loop = asyncio.get_running_loop()
        began_s = loop.time()
        try:
            progress.say("Making the robot ready.")
            await stand.make_ready()
            await self._collect(stand, progress)
        finally:
            self._spent_s += loop.time() - began_s
        progress.say("Working out how the robot is built.")
        return await asyncio.to_thread(
            result_of,
            self._looks,
            stand,
            self._known(stand),
            made_by=self.by,
            duration_s=self._spent_s,
            source=f"{len(self._looks)} looks at the label of {self.vehicle.name}",
        )

    async def _collect(self, stand: Stand, progress: Progress) -> None:
        if self._left is None or progress.done >= POSES:
            await self._begin(stand, progress)
            await self._remember(stand)
        else:
            await self._require_unmoved(stand, progress)
        progress.say("Looking at the label from many places.")
        while (room := POSES - progress.done - 1) > 0:
            if not self._left or len(self._left) > room:
                self._left = await asyncio.to_thread(self._next_places, stand, room)
            await self._look_from(stand, progress, self._left)
            await self._remember(stand)
            if room == 1:
                await self._require_unmoved(stand, progress)
        if len(self._looks) < FEWEST_LOOKS:
            raise LabelLostError(
                f"The label was seen from {len(self._looks)} of {progress.done} places; "
                f"{FEWEST_LOOKS} are needed.",
                looks=len(self._looks),
            )

    async def _look_from(self, stand: Stand, progress: Progress, left: list[JointPosition]) -> None:
        """Look from the next place; one that cannot be had is left out, and counts."""
        try:
            await stand.go_joints(left[0])
            look = await stand.look()
        except (MotionOutOfReachError, ActuatorOverloadError):
            look = None
        left.pop(0)
        self._take(stand, progress, look)

    async def _remember(self, stand: Stand) -> None:
        if self._first is None or self._left is None:
            raise AssertionError("looks were kept before there was a place to come back to")
        x_mm, y_mm = self._first.platform_mm.tolist()
        await stand.remember(
            RobotMemory(
                request=self.request,
                vehicle_id=self.vehicle.id,
                stood_at=self._first.joints,
                platform_mm=(x_mm, y_mm),
                first=KeptLook.of(self._first.look),
                looks=tuple(map(KeptLook.of, self._looks)),
                left=tuple(self._left),
                spent_s=self._spent_s,
            )
        )

    async def _begin(self, stand: Stand, progress: Progress) -> None:
        progress.restart()
        progress.say("Looking for the label.")
        self._looks.clear()
        self._left = None
        found = self._here(stand, await stand.find_label())
        # it may have come there from either side, so this look is not kept
        progress.looked(*found.platform_mm.tolist(), seen=True)
        progress.total = POSES
        # before the way to the middle: with wrong motors the label would be lost on it
        progress.say("Checking that each motor moves its own carriage.")
        checked = await self._check_wiring(stand, progress, found)
        await stand.go_joints(found.joints)
        centred = await stand.centre_label(found.look)
        self._first = self._here(stand, centred)
        self._take(stand, progress, centred)
        if not checked and not await self._check_wiring(stand, progress, self._first):
            raise LabelLostError(
                f"After a step of {WIRING_STEP_MM:g} mm the label was out of the picture."
            )
        self._left = []

    async def _check_wiring(self, stand: Stand, progress: Progress, first: FirstLook) -> bool:
        """Move each carriage a little; False if the label was lost by that."""
        steps = WIRING_STEP_MM * np.eye(2)
        moved = []
        for step in steps:
            await stand.go_joints(
                first.joints._replace(
                    rho1_mm=first.joints.rho1_mm + step[0], rho2_mm=first.joints.rho2_mm + step[1]
                )
            )
            look = await stand.look()
            self._take(stand, progress, look)
            if look is None:
                return False
            moved.append(stand.R_base_camera @ (first.look.label_mm - look.label_mm))
        drawn = PlanarAsBuilt.as_drawn(stand.supervisor.geometry)
        check_wiring(drawn, first.look.rho_mm, steps, np.stack(moved)[:, :2])
        return True

    @staticmethod
    def _here(stand: Stand, look: LabelLook) -> FirstLook:
        joints = stand.supervisor.telemetry.require().commanded.position
        return FirstLook(joints, stand.platform_mm, look)

    def _next_places(self, stand: Stand, room: int) -> list[JointPosition]:
        if self._first is None:
            raise AssertionError("places were chosen before the label was found")
        return next_places(stand, self._known(stand), self._first, self._looks, room)

    async def _require_unmoved(self, stand: Stand, progress: Progress) -> None:
        if self._first is None:
            raise AssertionError("the label was compared before it was seen")
        progress.say("Looking whether the label is where it was.")
        await stand.go_joints(self._first.joints)
        look = await stand.look()
        self._take(stand, progress, look)
        if look is None:
            raise LabelLostError("From the first place the label is not to be seen any more.")
        moved_mm = float(np.linalg.norm((look.label_mm - self._first.look.label_mm)[:2]))
        if moved_mm > MOVED_MM:
            raise LabelMovedError(
                f"Seen from the first place again, it is {moved_mm:.1f} mm off. Nothing was kept.",
                moved_mm=round(moved_mm, 3),
            )

    def _take(self, stand: Stand, progress: Progress, look: LabelLook | None) -> None:
        x_mm, y_mm = stand.platform_mm.tolist()
        if look is not None:
            self._looks.append(look)
        progress.looked(x_mm, y_mm, seen=look is not None)

    def _known(self, stand: Stand) -> KnownBefore:
        return known_before(
            self.request, self.vehicle.label_size_mm, stand.belts, lens_sigma_rad(stand)
        )
