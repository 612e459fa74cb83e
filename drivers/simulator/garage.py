"""One simulated garage, ready to be used in place of the real one, or around a real robot."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.camera import CameraModel
from drivers.simulator.build import built_optics
from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.following import RobotFollower, without_motors
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.robot import SimulatedRobot
from drivers.simulator.station import SimulatedStation
from drivers.simulator.world import SimulatedWorld
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.motion.limits import MotionLimits
from twin.statics import DEFAULT_TABLES, SagTables


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


@dataclass(frozen=True, slots=True)
class FollowedGarage:
    """What stands around a robot that is not simulated.

    Attributes:
        world: Physics, car and truth; its robot stands where the real one says it stands.
        camera: A CameraDriver.
        station: A StationDriver.
        follower: To be given the telemetry of the robot.
    """

    world: SimulatedWorld
    camera: SimulatedCamera
    station: SimulatedStation
    follower: RobotFollower


def build_garage(
    geometry: RobotGeometry,
    limits: MotionLimits,
    mount: CameraMount,
    optics: CameraModel,
    parameters: SimulationParameters,
    *,
    seed: int,
    imaging: ImagingParameters | None = None,
    sag: SagTables = DEFAULT_TABLES,
) -> SimulatedGarage:
    """Build a garage whose robot, camera and car differ from their drawings by chance.

    Args:
        geometry: The robot as drawn.
        limits: How fast its joints may move.
        mount: The camera on the platform, as drawn.
        optics: The camera as its data sheet says.
        parameters: All numbers of the simulation.
        seed: Decides everything random; the same seed gives the same garage and the same run.
        imaging: Light, exposure and noise of the camera; None takes those of the parameters.
        sag: How far the robot sags under its own weight.
    """
    world = SimulatedWorld(geometry, limits, mount, parameters, seed, sag=sag)
    camera = _camera(world, optics, imaging, seed)
    return SimulatedGarage(world, SimulatedRobot(world), camera, SimulatedStation(world))


def build_followed_garage(
    geometry: RobotGeometry,
    limits: MotionLimits,
    mount: CameraMount,
    optics: CameraModel,
    parameters: SimulationParameters,
    *,
    seed: int,
    imaging: ImagingParameters | None = None,
    sag: SagTables = DEFAULT_TABLES,
) -> FollowedGarage:
    """Build a garage around a robot that is not simulated.

    It takes what ``build_garage`` takes, and with the same seed it is the same garage: the same
    car, the same camera, the same errors of the build.
    """
    world = SimulatedWorld(geometry, limits, mount, without_motors(parameters), seed, sag=sag)
    camera = _camera(world, optics, imaging, seed)
    return FollowedGarage(world, camera, SimulatedStation(world), RobotFollower(world))


def _camera(
    world: SimulatedWorld, optics: CameraModel, imaging: ImagingParameters | None, seed: int
) -> SimulatedCamera:
    parameters = world.parameters
    true_optics = built_optics(optics, parameters.build, world.streams.optics)
    return SimulatedCamera(
        world.view_at, true_optics, imaging or parameters.imaging, seed, parameters.conditions
    )
