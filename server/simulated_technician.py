"""What a technician does by hand, done by somebody who knows how the simulated world really is."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator import poses
from drivers.simulator.car import ParkedCar
from drivers.simulator.truth import state_from_below
from drivers.simulator.view import Pose
from drivers.simulator.watching import plug_pose
from drivers.simulator.world import SimulatedWorld
from server.calibration.axes.estimates import Array
from server.calibration.camera.board_views import find_board
from server.calibration.camera.coverage import coverage_map
from server.calibration.camera.solve import solve_camera
from server.calibration.camera.verdict import judge
from server.calibration.versions.new_calibration import NewCalibration
from server.labels.board_layout import BoardLayout
from server.schema.calibrations import CameraValues
from server.schema.routines import BeltReading, RobotRoutineRequest
from server.services import Services
from server.simulated_board import board_pictures
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.motion import plan_joint_move

RULE_MM, RULE_SIGMA_MM = 400.0, 0.1
LABEL_SIGMA_MM = 0.1
GUIDED_TO_MM = 0.03
"""How exactly a hand finds the middle of the socket, by feeling the play on both sides."""
INSERTION_SPEED = 0.5
BOARD_PICTURES = 18
_ROUNDS = 8


@dataclass(frozen=True, slots=True)
class SimulatedTechnician:
    """Somebody with a rule, a calliper and patience.

    Attributes:
        services: What runs.
        world: How it really is.
        rng: Decides how exactly the hand works.
    """

    services: Services
    world: SimulatedWorld
    rng: np.random.Generator

    def request(self) -> RobotRoutineRequest:
        """What rule and calliper say."""
        mechanism = self.world.plant.mechanism
        left, right = (
            BeltReading(
                commanded_mm=RULE_MM,
                measured_mm=RULE_MM * scale + math.sqrt(2) * self.rng.normal(0.0, RULE_SIGMA_MM),
                reading_sigma_mm=RULE_SIGMA_MM,
            )
            for scale in (mechanism.left_scale, mechanism.right_scale)
        )
        return RobotRoutineRequest(left_belt=left, right_belt=right, label_sigma_mm=LABEL_SIGMA_MM)

    def camera_calibration(self, camera: CameraModel, made_by: str) -> NewCalibration:
        """Photograph the board and solve for the camera, as `plugpilot calibrate camera` does.

        Args:
            camera: How it really is.
            made_by: Who does it.

        Raises:
            CameraCalibrationError: the pictures lead to no camera.
        """
        layout, rng = BoardLayout(), self.rng.spawn(1)[0]
        found = find_board(board_pictures(camera, layout, BOARD_PICTURES, rng), layout)
        solution = solve_camera(found)
        verdict = judge(solution, coverage_map(found.views, found.width_px, found.height_px))
        return NewCalibration(
            values=CameraValues(camera=solution.camera),
            made_by=made_by,
            source=f"{len(found.views)} pictures of the board",
            grade=verdict.grade,
            remarks=verdict.remarks,
            error=solution.check_px,
        )

    async def plug_in_by_hand(self) -> None:
        """Jog the plug all the way into the socket.

        Raises:
            ControlError: it does not go in.
        """
        supervisor, settings = self.services.supervisor, self.services.settings.insertion
        before, mated = self._guided(settings.depth_mm)
        async with supervisor.control("jog", "Simulated technician") as lease:
            await supervisor.move_from_below(lease, before)
            await supervisor.set_force_limit(lease, settings.force_limit_n)
            slowly = supervisor.limits.scaled(INSERTION_SPEED)
            await supervisor.follow(lease, plan_joint_move(slowly, before, mated))

    def park_elsewhere(self, most_mm: float, usual: ParkedCar | None = None) -> None:
        """The same car comes again, as drivers park: shifted along the wall and in height.

        Args:
            most_mm: By so much at most.
            usual: From there; None: from where it stands.
        """
        car = usual or self.world.car
        x_mm, y_mm = self.rng.uniform(-most_mm, most_mm, 2).tolist()
        turn = poses.rotation_y(float(self.rng.normal(0.0, math.radians(0.4))))
        socket = car.T_base_socket[:3, 3]
        about_socket = poses.pose(turn, socket + np.array([x_mm, y_mm, 0.0]) - turn @ socket)
        self.world.put_car(car.moved(about_socket))

    def _guided(self, depth_mm: float) -> tuple[JointPosition, JointPosition]:
        """Joints before the socket, and with the plug in it, so that it really goes in straight."""
        geometry, built = self.services.settings.geometry, self.services.supervisor.built
        socket = self.world.car.T_base_socket
        beside_mm = self.rng.normal(0.0, GUIDED_TO_MM, 2)
        platform = np.array([geometry.regular_box.center_x_mm, geometry.regular_box.center_y_mm])
        face_mm = geometry.rho3.min_mm  # of the slide, once the tip is level with it
        for _ in range(_ROUNDS):
            drawn = np.array([*alpha.inverse_many(geometry, platform), face_mm])
            board = built.correction.to_board_many(drawn) if built.correction else drawn
            pierced_mm, before_mm = _aim(self.world, board, socket)
            platform = platform - pierced_mm[:2] + beside_mm
            face_mm += before_mm
        mated = face_mm + depth_mm
        rho1_mm, rho2_mm, _ = drawn.tolist()
        return (
            JointPosition(rho1_mm, rho2_mm, geometry.rho3.min_mm),
            JointPosition(rho1_mm, rho2_mm, min(mated, geometry.rho3.max_mm)),
        )


def _aim(world: SimulatedWorld, board: Array, socket: Pose) -> tuple[NDArray[np.float64], float]:
    """Where the plug's axis meets the socket's face, from its centre, and how far before it it is.

    Args:
        world: With the robot as built.
        board: Its joints, all come from below, shape (3,) [mm].
        socket: T_base_socket.
    """
    play_mm = world.parameters.drives.backlash_mm
    joints = JointPosition(*board.tolist())
    state = state_from_below(joints, world.surroundings.zero, play_mm)
    plug = plug_pose(world.plant, state)
    axis, normal = plug[:3, 2], socket[:3, 2]
    to_face = socket[:3, 3] - plug[:3, 3]
    way_mm = float(to_face @ normal) / float(axis @ normal)
    return axis * way_mm - to_face, way_mm
