"""One simulated garage, ready to be used in place of the real one."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.camera import CameraModel
from drivers.simulator.build import built_optics
from drivers.simulator.camera import ImagingParameters, SimulatedCamera
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.robot import SimulatedRobot
from drivers.simulator.station import SimulatedStation
from drivers.simulator.world import SimulatedWorld
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.motion.limits import MotionLimits


@dataclass(frozen=True, slots=True)
class SimulatedGarage:
    """The drivers of one garage, and the world behind them.

    Attributes:
        world: Physics, car and truth.
        robot: A RobotDriver.
        camera: A CameraDriver.
        station: A StationDriver.
    """

    world: SimulatedWorld
    robot: SimulatedRobot
    camera: SimulatedCamera
    station: SimulatedStation


def build_garage(
    geometry: RobotGeometry,
    limits: MotionLimits,
    mount: CameraMount,
    optics: CameraModel,
    parameters: SimulationParameters,
    *,
    seed: int,
    imaging: ImagingParameters | None = None,
) -> SimulatedGarage:
    """Build a garage whose robot, camera and car differ from their drawings by chance.

    Args:
        geometry: The robot as drawn.
        limits: How fast its joints may move.
        mount: The camera on the platform, as drawn.
        optics: The camera as its data sheet says.
        parameters: All numbers of the simulation.
        seed: Decides everything random; the same seed gives the same garage and the same run.
        imaging: Light, exposure and noise of the camera; None takes its defaults.
    """
    world = SimulatedWorld(geometry, limits, mount, parameters, seed)
    true_optics = built_optics(optics, parameters.build, world.streams.optics)
    camera = SimulatedCamera(world.view_at, true_optics, imaging or ImagingParameters(), seed)
    return SimulatedGarage(world, SimulatedRobot(world), camera, SimulatedStation(world))
