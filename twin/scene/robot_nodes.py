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
from twin.scene.cable import Cable
from twin.scene.frames import Vector, turn
from twin.scene.frustum import add_frustum
from twin.scene.nodes import (
    add_part,
    add_pivot,
    place,
    place_transform,
    set_visible,
    turn_to,
)
from twin.scene.overlays import CAMERA, GHOST
from twin.scene.plug_cable import PlugCable
from twin.scene.shapes import Points
from twin.scene.state import TwinState

logger = logging.getLogger(__name__)

PARTED_MM = 5.0
"""Distance of commanded and measured plug tip from which the ghost is shown."""
BEYOND_STROKE_MM = 1.0
"""Distance outside a joint's range from which the picture says so."""

_X: Vector = (1.0, 0.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)


class RobotNodes:
    """Every moving part is a node whose origin is the part's pivot.

    A and E carry the carriages, and they the bars, which turn about A, D and E; V carries the
    platform and the plug tip P the plug. The parts are hidden while the joints are unknown: the
    picture claims nothing that nobody measured.

    Attributes:
        trouble: What is wrong with the last joints in one sentence, empty if nothing is.
    """

    def __init__(
        self,
        scene: SceneApi,
        geometry: RobotGeometry,
        mount: CameraMount,
        *,
        hfov_rad: float,
        aspect: float,
        cable: Cable,
    ) -> None:
        g = geometry
        self._geometry = g
        self._along_axis = turn(_X, -g.theta_rad)
        self._cable_outlet_mm = plug_parts.cable_outlet_mm()
        self._impossible: JointPosition | None = None
        self.trouble = ""
        add_part(scene, "/rails", robot_parts.rails(g))
        self.robot = add_pivot(scene, "/robot", visible=False)
        self.left_carriage = add_part(scene, "/robot/left_carriage", robot_parts.left_carriage(g))
        self.right_carriage = add_part(
            scene, "/robot/right_carriage", robot_parts.right_carriage(g)
        )
        bar = robot_parts.bar(g)
        d_from_a = (g.platform_width_mm / 2, g.e_py_mm, 0.0)
        self.bar_ab = add_part(scene, "/robot/left_carriage/bar_ab", bar)
        self.bar_df = add_part(scene, "/robot/left_carriage/bar_df", bar, at_mm=d_from_a)
        self.bar_ec = add_part(scene, "/robot/right_carriage/bar_ec", bar)
        self.platform = add_pivot(scene, "/robot/platform")
        add_part(scene, "/robot/platform/body", robot_parts.platform(g))
        rise, reach = gamma.tip_offset(g, 0.0)
        slide = plug_parts.slide(layers.PLATFORM_FRONT_Z - reach, g.rho3.min_mm, g.rho3.max_mm)
        at = (0.0, rise, reach)
        add_part(scene, "/robot/platform/slide", slide, at_mm=at, wxyz=self._along_axis)
        self.plug = add_part(
            scene, "/robot/platform/plug", plug_parts.plug(), wxyz=self._along_axis
        )
        body = robot_parts.camera_body(mount.x_mm, mount.y_mm, mount.z_mm)
        add_part(scene, "/robot/platform/camera_body", body)
        camera = add_pivot(scene, "/robot/platform/camera")
        place_transform(camera, mount.T_platform_camera)
        add_frustum(scene, CAMERA.nodes[0], hfov_rad=hfov_rad, aspect=aspect)
        add_pivot(scene, GHOST.nodes[0])
        ghost = f"{GHOST.nodes[0]}/plug"
        outline = plug_parts.outline_of_plug()
        self.ghost = add_part(scene, ghost, outline, wxyz=self._along_axis, shadow=False)
        self.cable = PlugCable(scene, room.cable_inlet_mm(g), cable)

    def show(self, state: TwinState) -> None:
        """Moves the parts to the measured joints; shows the ghost where they part."""
        self.trouble = self._beyond_stroke(state.measured)
        measured = self._pose_of(state.measured)
        commanded = self._pose_of(state.commanded)
        set_visible(self.robot, visible=measured is not None)
        set_visible(self.cable.node, visible=measured is not None)
        if measured is not None:
            self._move(measured)
        self._show_ghost(measured, commanded)

    def _beyond_stroke(self, joints: JointPosition | None) -> str:
        """Names the joint that is farthest outside its range; empty if none is."""
        if joints is None:
            return ""
        ranges = self._geometry.joint_ranges
        excesses = [r.excess_mm(q) for r, q in zip(ranges, joints, strict=True)]
        worst = max(range(3), key=lambda i: abs(excesses[i]))
        if not abs(excesses[worst]) > BEYOND_STROKE_MM:
            return ""
        return f"rho{worst + 1} is {abs(excesses[worst]):.0f} mm outside its range"

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
            self.trouble = "No pose of the robot belongs to these joint positions"
            return None

    def _move(self, pose: poses.RobotPose) -> None:
        left = turn(_Z, pose.left_angle_rad)
        place(self.left_carriage, pose.a)
        turn_to(self.bar_ab, left)
        turn_to(self.bar_df, left)
        place(self.right_carriage, pose.e)
        turn_to(self.bar_ec, turn(_Z, pose.right_angle_rad))
        place(self.platform, pose.v)
        x, y, z = (float(p - v) for p, v in zip(pose.plug, pose.v, strict=True))
        place(self.plug, (x, y, z))
        self.cable.hang_to(self.plug_point_mm(pose.plug, self._cable_outlet_mm))

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
            if parted_mm >= PARTED_MM:
                place(self.ghost, commanded.plug)
        set_visible(self.ghost, visible=parted_mm >= PARTED_MM)
