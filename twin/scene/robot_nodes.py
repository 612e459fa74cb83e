"""The robot in the picture: its nodes, and where they go for given joints."""

from __future__ import annotations

import logging

import numpy as np
from viser import SceneApi

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.kinematics.errors import KinematicsError
from twin.scene import layers, plug_parts, poses, robot_parts, room
from twin.scene.frames import Vector, turn
from twin.scene.frustum import add_frustum
from twin.scene.materials import FORCE, GHOST
from twin.scene.nodes import add_part, add_pivot, add_signal, place, place_transform, set_visible
from twin.scene.plug_cable import PlugCable
from twin.scene.shapes import Points, rod
from twin.scene.state import TwinState

logger = logging.getLogger(__name__)

PARTED_MM = 5.0
"""Distance of commanded and measured plug tip from which the ghost is shown."""
LEAST_FORCE_N = 3.0
"""Smallest force that gets an arrow."""
ARROW_MM_PER_N = 1.5

_X: Vector = (1.0, 0.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)
_ARROW_WIDTH = 0.006


class RobotNodes:
    """Every moving part is a node whose origin is the part's pivot.

    A, D and E carry the carriages and bars, V the platform, the plug tip P the plug. The parts
    are hidden while the joints are unknown: the picture claims nothing that nobody measured.
    """

    def __init__(
        self,
        scene: SceneApi,
        geometry: RobotGeometry,
        mount: CameraMount,
        *,
        hfov_rad: float,
        aspect: float,
    ) -> None:
        g = geometry
        self._geometry = g
        self._along_axis = turn(_X, -g.theta_rad)
        self._impossible: JointPosition | None = None
        add_part(scene, "/rails", robot_parts.rails(g))
        self.robot = add_pivot(scene, "/robot", visible=False)
        self.left_carriage = add_part(scene, "/robot/left_carriage", robot_parts.left_carriage(g))
        self.right_carriage = add_part(
            scene, "/robot/right_carriage", robot_parts.right_carriage(g)
        )
        bar = robot_parts.bar(g)
        self.bar_ab = add_part(scene, "/robot/bar_ab", bar)
        self.bar_df = add_part(scene, "/robot/bar_df", bar)
        self.bar_ec = add_part(scene, "/robot/bar_ec", bar)
        self.platform = add_pivot(scene, "/robot/platform")
        add_part(scene, "/robot/platform/body", robot_parts.platform(g))
        rise, reach = gamma.tip_offset(g, 0.0)
        slide = plug_parts.slide(layers.PLATFORM_FRONT_Z - reach, g.rho3.min_mm, g.rho3.max_mm)
        at = (0.0, rise, reach)
        add_part(scene, "/robot/platform/slide", slide, at_mm=at, wxyz=self._along_axis)
        self.plug = add_part(scene, "/robot/platform/plug", plug_parts.plug())
        body = robot_parts.camera_body(mount.x_mm, mount.y_mm, mount.z_mm)
        add_part(scene, "/robot/platform/camera_body", body)
        camera = add_pivot(scene, "/robot/platform/camera")
        place_transform(camera, mount.T_platform_camera)
        add_frustum(scene, "/robot/platform/camera/view", hfov_rad=hfov_rad, aspect=aspect)
        self.ghost = add_signal(scene, "/ghost", plug_parts.outline_of_plug(), GHOST, opacity=0.6)
        # A metre long and a metre wide: its scale is its size. It points along the plug's z.
        arrow = rod(1000.0, 1000.0, chamfer_mm=300.0, count=20)
        self.force = add_signal(scene, "/robot/platform/plug/force", arrow, FORCE)
        place(self.force, (0.0, plug_parts.PLUG_RADIUS + 30.0, -20.0))
        self.cable = PlugCable(scene, room.cable_inlet_mm(g))

    def show(self, state: TwinState) -> None:
        """Moves the parts to the measured joints; shows the ghost and the force arrow."""
        measured = self._pose_of(state.measured)
        commanded = self._pose_of(state.commanded)
        set_visible(self.robot, visible=measured is not None)
        set_visible(self.cable.node, visible=measured is not None)
        if measured is not None:
            self._move(measured)
        self._show_ghost(measured, commanded)
        self._show_force(state.force_n)

    def _pose_of(self, joints: JointPosition | None) -> poses.RobotPose | None:
        """Pose for joints, None while they are unknown or belong to no pose at all."""
        if joints is None:
            return None
        try:
            return poses.robot_pose(self._geometry, joints)
        except KinematicsError as error:
            if joints != self._impossible:
                logger.warning("The picture cannot show these joints: %s", error)
            self._impossible = joints
            return None

    def _move(self, pose: poses.RobotPose) -> None:
        left, right = turn(_Z, pose.left_angle_rad), turn(_Z, pose.right_angle_rad)
        place(self.left_carriage, pose.a)
        place(self.right_carriage, pose.e)
        place(self.bar_ab, pose.a, left)
        place(self.bar_df, pose.d, left)
        place(self.bar_ec, pose.e, right)
        place(self.platform, pose.v)
        x, y, z = (float(p - v) for p, v in zip(pose.plug, pose.v, strict=True))
        place(self.plug, (x, y, z), self._along_axis)
        self.cable.hang_to(self.plug_point_mm(pose.plug, plug_parts.cable_outlet_mm()))

    def plug_point_mm(self, tip_mm: Vector, point_mm: Points) -> Points:
        """A point of the plug's frame, shape (3,), in the base frame, for a place of its tip."""
        _, s, c = self._geometry.insertion_axis
        x, y, z = (float(value) for value in point_mm)
        return np.array([tip_mm[0] + x, tip_mm[1] + c * y + s * z, tip_mm[2] + c * z - s * y])

    def _show_ghost(
        self, measured: poses.RobotPose | None, commanded: poses.RobotPose | None
    ) -> None:
        parted_mm = 0.0
        if measured is not None and commanded is not None:
            parted_mm = float(np.linalg.norm(np.subtract(commanded.plug, measured.plug)))
            place(self.ghost, commanded.plug, self._along_axis)
        set_visible(self.ghost, visible=parted_mm >= PARTED_MM)

    def _show_force(self, force_n: float) -> None:
        visible = abs(force_n) >= LEAST_FORCE_N
        set_visible(self.force, visible=visible)
        if visible:
            # Pushed back, the plug feels a force against its axis.
            length = round(-force_n) * ARROW_MM_PER_N / 1000
            self.force.scale = (_ARROW_WIDTH, _ARROW_WIDTH, length)
