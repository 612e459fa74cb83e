"""A place that somebody has chosen: the robot's ghost there, and the way to it."""

from __future__ import annotations

import logging

from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.kinematics.errors import KinematicsError
from twin.scene import plug_parts, robot_parts
from twin.scene.frames import Vector, turn
from twin.scene.glb import Part
from twin.scene.materials import AHEAD
from twin.scene.nodes import add_part, add_pivot, place, set_visible, turn_to
from twin.scene.overlays import TARGET
from twin.scene.overlays.path import PathNodes
from twin.scene.poses import RobotPose, robot_pose
from twin.scene.state import ChosenTarget

logger = logging.getLogger(__name__)

_NAME = TARGET.nodes[0]
_X: Vector = (1.0, 0.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)


class TargetNodes:
    """The ghost and a line to it. Browsers get the ghost's shapes with the first place only."""

    def __init__(self, scene: SceneApi, geometry: RobotGeometry) -> None:
        self._scene = scene
        self._geometry = geometry
        self._shown: ChosenTarget | None = None
        add_pivot(scene, _NAME)
        self.path = PathNodes(scene, f"{_NAME}/path")
        self.ghost: Ghost | None = None

    def show(self, target: ChosenTarget | None) -> None:
        """Puts the ghost at a place; hides it and its way while there is none."""
        if target is self._shown:
            return
        self._shown = target
        self.path.show(target.path if target is not None else None)
        pose = self._pose_of(target) if target is not None else None
        if pose is not None and self.ghost is None:
            self.ghost = Ghost(self._scene, self._geometry)
        if self.ghost is not None:
            self.ghost.show(pose)

    def _pose_of(self, target: ChosenTarget) -> RobotPose | None:
        try:
            return robot_pose(self._geometry, target.joints)
        except KinematicsError as error:
            logger.warning("The picture cannot show the chosen place: %s", error)
            return None


class Ghost:
    """Platform, bars and plug where they would be."""

    def __init__(self, scene: SceneApi, geometry: RobotGeometry) -> None:
        self.whole = add_pivot(scene, f"{_NAME}/ghost", visible=False)
        bar = _as_ghost(robot_parts.bar(geometry))
        self._bars = [
            add_part(scene, f"{_NAME}/ghost/bar_{which}", bar, shadow=False)
            for which in ("ab", "df", "ec")
        ]
        platform = _as_ghost(robot_parts.platform(geometry))
        self.platform = add_part(scene, f"{_NAME}/ghost/platform", platform, shadow=False)
        self.plug = add_part(
            scene,
            f"{_NAME}/ghost/plug",
            plug_parts.outline_of_plug(),
            wxyz=turn(_X, -geometry.theta_rad),
            shadow=False,
        )

    def show(self, pose: RobotPose | None) -> None:
        """Puts it into a pose; hides it without one."""
        if pose is not None:
            self._move(pose)
        set_visible(self.whole, visible=pose is not None)

    def _move(self, pose: RobotPose) -> None:
        left, right = turn(_Z, pose.left_angle_rad), turn(_Z, pose.right_angle_rad)
        pivots = ((pose.a, left), (pose.d, left), (pose.e, right))
        for bar, (pivot, angle) in zip(self._bars, pivots, strict=True):
            place(bar, pivot)
            turn_to(bar, angle)
        place(self.platform, pose.v)
        place(self.plug, pose.plug)


def _as_ghost(parts: list[Part]) -> list[Part]:
    return [(mesh, AHEAD) for mesh, _ in parts]
