"""The whole picture: builds every node once, then only moves them."""

from __future__ import annotations

from viser import SceneApi

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import room
from twin.scene.cable import Cable
from twin.scene.car_nodes import CarNodes
from twin.scene.divergence_marks import DivergenceMarks
from twin.scene.lights import add_lights
from twin.scene.nodes import add_label, add_part, set_text, set_visible
from twin.scene.overlays.forces import ForceNodes
from twin.scene.overlays.maps import add_condition_map, add_nine_points
from twin.scene.overlays.path import PathNodes
from twin.scene.overlays.regions import add_regions, reach_of
from twin.scene.overlays.spread import InvalidCovarianceError, SpreadNodes
from twin.scene.overlays.target import TargetNodes
from twin.scene.robot_nodes import RobotNodes
from twin.scene.state import TwinState
from twin.statics import ActuatorLimits, Loads, SagTables

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
        loads: Loads,
        limits: ActuatorLimits,
        sag: SagTables,
    ) -> None:
        """Builds the scene and shows a robot of which nothing is known.

        Args:
            scene: Empty viser scene.
            geometry: The robot.
            mount: Where its camera sits.
            hfov_rad: The camera's horizontal field of view.
            aspect: Width of its picture divided by its height.
            loads: What the robot carries, its cable too, and the largest forces at the plug.
            limits: What its actuators can hold.
            sag: The table of the sag at the nine points.
        """
        scene.set_up_direction("+y")
        add_lights(scene)
        add_part(scene, "/room/floor", room.floor(geometry), shadow=False)
        add_part(scene, "/room/wall", room.wall(geometry), shadow=False)
        add_part(scene, "/room/wall_base", room.wall_base(geometry), shadow=False)
        x, y, z = room.station_place_mm(geometry)
        add_part(scene, "/room/station", room.station(), at_mm=(x, y, z))
        self.robot = RobotNodes(
            scene, geometry, mount, hfov_rad=hfov_rad, aspect=aspect, cable=Cable.of(loads)
        )
        self.car = CarNodes(scene, geometry)
        self._add_overlays(scene, geometry, sag)
        self.forces = ForceNodes(scene, geometry, loads, limits)
        at = (geometry.base_width_mm / 2, geometry.e1y_mm + 60.0, 0.0)
        self.notice = add_label(scene, "/notice", "", at_mm=at, visible=False)
        self.divergence = DivergenceMarks(scene)
        self._charging = False
        self.show(TwinState())

    def _add_overlays(self, scene: SceneApi, geometry: RobotGeometry, sag: SagTables) -> None:
        reach = reach_of(geometry)
        add_regions(scene, geometry, reach)
        add_condition_map(scene, geometry, reach)
        add_nine_points(scene, geometry, sag)
        self.path = PathNodes(scene)
        self.target = TargetNodes(scene, geometry)
        self.spread = SpreadNodes(scene)

    def show(self, state: TwinState) -> None:
        """Moves every node to a state. Nodes that did not move send nothing.

        What cannot be drawn is left out, and the picture says why.
        """
        self.robot.show(state)
        self.car.show(state)
        self.divergence.show(state)
        self.path.show(state.path)
        self.target.show(state.target)
        self.forces.show(state, self.robot.cable.pull_n if state.measured else None)
        trouble = self.robot.trouble
        try:
            self.spread.show(state)
        except InvalidCovarianceError as error:
            trouble = trouble or str(error)
        if trouble:
            set_text(self.notice, trouble)
        set_visible(self.notice, visible=bool(trouble))
        self._charging = state.charging

    def animate(self, time_s: float) -> None:
        """Moves what takes its own time: cable, the light along it while the car charges, alarms.

        Args:
            time_s: Of any clock, growing from call to call.
        """
        self.robot.cable.follow(time_s)
        step = int(time_s * _LINKS_PER_S) if self._charging else None
        self.robot.cable.show_flow(step)
        self.divergence.animate(time_s)
