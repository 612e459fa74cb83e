"""The whole picture: builds every node once, then only moves them."""

from __future__ import annotations

from viser import SceneApi

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import room
from twin.scene.car_nodes import CarNodes
from twin.scene.lights import add_lights
from twin.scene.nodes import add_part
from twin.scene.robot_nodes import RobotNodes
from twin.scene.state import TwinState
from twin.scene.workspace_region import add_workspace_region

_LINKS_PER_S = 12.0
"""Speed of the light along the cable."""


class TwinScene:
    """The nodes of the robot, its garage and the car in one viser scene.

    The scene's frame is the base frame with y up, in metres.
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
        """Builds the scene and shows a robot of which nothing is known.

        Args:
            scene: Empty viser scene.
            geometry: The robot.
            mount: Where its camera sits.
            hfov_rad: The camera's horizontal field of view.
            aspect: Width of its picture divided by its height.
        """
        scene.set_up_direction("+y")
        add_lights(scene)
        add_part(scene, "/room/floor", room.floor(geometry), shadow=False)
        add_part(scene, "/room/wall", room.wall(geometry), shadow=False)
        add_part(scene, "/room/wall_base", room.wall_base(geometry), shadow=False)
        x, y, z = room.station_place_mm(geometry)
        add_part(scene, "/room/station", room.station(), at_mm=(x, y, z))
        add_workspace_region(scene, geometry)
        self.robot = RobotNodes(scene, geometry, mount, hfov_rad=hfov_rad, aspect=aspect)
        self.car = CarNodes(scene, geometry)
        self._charging = False
        self.show(TwinState())

    def show(self, state: TwinState) -> None:
        """Moves every node to a state. Nodes that did not move send nothing."""
        self.robot.show(state)
        self.car.show(state)
        self._charging = state.charging

    def animate(self, time_s: float) -> None:
        """Moves the light that runs along the cable while the car charges."""
        step = int(time_s * _LINKS_PER_S) if self._charging else None
        self.robot.cable.show_flow(step)
