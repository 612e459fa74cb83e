"""The robot before a label that stands still: go somewhere, come to rest, look."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.robot import RobotState
from server.calibration.axes.estimates import Estimate
from server.calibration.robot.looks import LabelLook
from server.calibration.routines.board_feed import BoardFeed
from server.calibration.routines.errors import LabelLostError
from server.calibration.routines.robot_memory import RobotMemory
from server.calibration.versions.values import ValuesInForce
from server.config.settings import Settings
from server.control.errors import ActuatorOverloadError, MotionOutOfReachError, RobotOfflineError
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.localisation.errors import ImplausiblePlaceError
from server.localisation.eye import Eye
from server.localisation.looks import LookPlanner
from server.localisation.platform_places import can_stand
from server.localisation.telling import most_telling
from server.schema.calibrations import RobotEvidence
from server.schema.vehicles import Vehicle
from server.vision import AmbiguousLabelError, LabelPose, PoseRejectedError
from twin.as_built import PlanarAsBuilt
from twin.joints import JointPosition
from twin.kinematics import KinematicsError, PlatformPosition, alpha

Array = NDArray[np.float64]

FRAMES = 3
_STEPS_OF_A_WAY = 21
MEASURED = 1e-3
"""A belt whose scale is known better than that was measured with a rule: looks cannot tell it."""


@dataclass(frozen=True, slots=True)
class Stand:
    """What a routine has at hand.

    Attributes:
        supervisor: Owner of the robot.
        lease: Proof of control.
        eye: Camera and locator.
        owner: Whose label it looks at; None: it looks at none.
        settings: The whole configuration.
        as_taught: Puts the socket of a vehicle where it was taught.
        in_force: The numbers that count.
        evidence: What the calibration of the robot in force rests on, if anything.
        board: Shows pictures of the board to whoever watches.
        remember: Keeps what a routine has collected, for a restart.
    """

    supervisor: Supervisor
    lease: Lease
    eye: Eye
    owner: Vehicle | None
    settings: Settings
    as_taught: Callable[[Vehicle], Vehicle]
    in_force: ValuesInForce
    evidence: RobotEvidence | None
    board: BoardFeed
    remember: Callable[[RobotMemory], Awaitable[None]]

    @property
    def vehicle(self) -> Vehicle:
        """Whose label it looks at."""
        if self.owner is None:
            raise AssertionError("a routine looks for a label that it did not ask for")
        return self.owner

    @property
    def mechanism(self) -> PlanarAsBuilt:
        """The robot as far as known."""
        return self.in_force.mechanism or PlanarAsBuilt.as_drawn(self.supervisor.geometry)

    @property
    def belts(self) -> tuple[Estimate, Estimate] | None:
        """Scale of both belts as a rule has told for the calibration in force; None: it has not.

        What jobs have learnt since is no measurement: it begins from what it takes for measured.
        """
        mechanism, evidence = self.in_force.mechanism, self.evidence
        if mechanism is None or evidence is None or evidence.provenance != "routine":
            return None
        sigmas = [evidence.sigma.get(name, math.inf) for name in ("left_scale", "right_scale")]
        if max(sigmas) > MEASURED:
            return None
        left_sigma, right_sigma = sigmas
        return (
            Estimate(mechanism.left_scale, left_sigma),
            Estimate(mechanism.right_scale, right_sigma),
        )

    @property
    def board_rho_mm(self) -> Array:
        """Where the board has brought the carriages, as it counts, shape (2,) [mm]."""
        board = self._board_state.commanded.position
        return np.array([board.rho1_mm, board.rho2_mm])

    async def make_ready(self) -> None:
        """Drives on, zero known, plug drawn back.

        Raises:
            ControlError: the robot cannot be made ready, or the plug is not known to be free.
        """
        if not self.supervisor.telemetry.require().enabled:
            await self.supervisor.enable(self.lease)
        if not self.supervisor.telemetry.require().homed:
            await self.supervisor.home(self.lease)
        here = self.supervisor.telemetry.require().commanded.position
        back = here._replace(rho3_mm=self.supervisor.geometry.rho3.min_mm)
        await self.supervisor.move_joints(self.lease, back)

    async def find_label(self) -> LabelLook:
        """The label from wherever it is in the picture.

        Raises:
            LabelLostError: it is in no picture.
            ControlError, CameraDownError: the robot does not get there, or sees nothing at all.
        """
        look = await self.look()
        return await self._search() if look is None else look

    async def centre_label(self, look: LabelLook) -> LabelLook:
        """The label in the middle of the picture, or as near to it as the robot gets.

        Args:
            look: From where the robot stands.

        Raises:
            LabelLostError: it is not where it should be.
            ControlError, CameraDownError: as in ``find_label``.
        """
        sideways = self.R_base_camera @ (look.label_mm * np.array([1.0, 1.0, 0.0]))
        await self.go(self._towards(self.platform_mm + sideways[:2]))
        centred = await self.look()
        if centred is None:
            raise LabelLostError("The label was seen, but not from where it should be best seen.")
        return centred

    async def go(self, platform_mm: Array, run_up_mm: float | None = None) -> None:
        """Move the platform to a place, always from the same side.

        Args:
            platform_mm: x and y of V, shape (2,) [mm].
            run_up_mm: So far from there both carriages come to rest before the last piece of the
                way; None: just from below.

        Raises:
            ControlError: it cannot get there.
        """
        geometry = self.supervisor.geometry
        x_mm, y_mm = platform_mm.tolist()
        try:
            rho1_mm, rho2_mm = alpha.inverse(geometry, PlatformPosition(x_mm, y_mm))
        except KinematicsError as error:
            raise MotionOutOfReachError(str(error)) from error
        await self.go_joints(JointPosition(rho1_mm, rho2_mm, geometry.rho3.min_mm), run_up_mm)

    async def go_joints(self, joints: JointPosition, run_up_mm: float | None = None) -> None:
        """The same, given the joints of the drawing."""
        if run_up_mm is None:
            await self.supervisor.move_from_below(self.lease, joints)
            return
        before = joints._replace(
            rho1_mm=joints.rho1_mm + run_up_mm, rho2_mm=joints.rho2_mm + run_up_mm
        )
        await self.supervisor.move_joints(self.lease, before)
        await self.supervisor.move_joints(self.lease, joints)

    async def look(self) -> LabelLook | None:
        """Look at the label from here; None: it is not in the picture, or not well enough.

        Raises:
            CameraDownError: the camera does not deliver.
        """
        seen = await self.sight()
        if seen is None:
            return None
        return LabelLook(
            self.board_rho_mm,
            seen.T_camera_label[:3, 3].copy(),
            seen.covariance[3:, 3:].copy(),
            math.atan2(seen.T_camera_label[1, 0], seen.T_camera_label[0, 0]),
        )

    async def sight(self) -> LabelPose | None:
        """The label's pose in the camera frame; None as in ``look``.

        Raises:
            CameraDownError: the camera does not deliver.
        """
        try:
            return await self.eye.sight(self.vehicle, FRAMES)
        except (PoseRejectedError, AmbiguousLabelError, ImplausiblePlaceError):
            return None

    @property
    def platform_mm(self) -> Array:
        """Where the platform is believed to stand, shape (2,) [mm]."""
        joints = self.supervisor.telemetry.require().commanded.position
        return np.array(alpha.forward(self.supervisor.geometry, joints.rho1_mm, joints.rho2_mm))

    @property
    def R_base_camera(self) -> Array:  # noqa: N802 - a rotation names both frames
        """How the camera is believed to be turned, shape (3, 3)."""
        rotation: Array = self.eye.mount.T_platform_camera[:3, :3]
        return rotation

    @property
    def _board_state(self) -> RobotState:
        state = self.supervisor.board_state
        if state is None:
            raise RobotOfflineError("The motion board does not answer.")
        return state

    def _towards(self, place_mm: Array) -> Array:
        """A place, or the last one on the way to it where the robot can stand, shape (2,) [mm]."""
        here = self.platform_mm
        way = np.linspace(place_mm, here, _STEPS_OF_A_WAY)
        stands = can_stand(self.supervisor.geometry, self.supervisor.built, way)
        return np.asarray(way[np.argmax(stands)] if stands.any() else here)

    async def _search(self) -> LabelLook:
        """Look from where a label may be seen, one place after the other."""
        planner = LookPlanner(
            self.supervisor.geometry,
            self.supervisor.built,
            self.eye.known,
            self.vehicle,
            self.settings.insertion,
        )
        x_mm, y_mm = self.platform_mm.tolist()
        refusals = [self.eye.refusal]
        places = planner.further_looks(x_mm, y_mm, self.supervisor.geometry.rho3.min_mm)
        while (place := await asyncio.to_thread(next, places, None)) is not None:
            try:
                await self.go(np.array([place.x_mm, place.y_mm]))
            except (MotionOutOfReachError, ActuatorOverloadError):
                continue
            look = await self.look()
            if look is not None:
                return look
            refusals.append(self.eye.refusal)
        refusal = most_telling(refusals) or refusals[0]
        raise LabelLostError(
            f"The label of {self.vehicle.name} is in none of {len(refusals)} pictures."
            + (f" {refusal.detail}" if refusal is not None else ""),
            looks=len(refusals),
        )
