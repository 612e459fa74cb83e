"""Which drivers there are. A new one is a line in a table here, and a name in the configuration."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from drivers.arduino.driver import ArduinoRobot
from drivers.arduino.settings import BoardSettings
from drivers.camera import CameraDriver, CameraModel
from drivers.camera.grabbing import GrabbingCamera
from drivers.camera.picamera import PiCameraSource
from drivers.camera.replay import ReplaySource
from drivers.camera.settings import CameraLinks
from drivers.camera.stream import StreamSource
from drivers.camera.v4l2 import V4l2Source
from drivers.errors import UnknownDriverError
from drivers.robot import RobotDriver
from drivers.simulator.garage import (
    FollowedGarage,
    SimulatedGarage,
    build_followed_garage,
    build_garage,
)
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.world import SimulatedWorld
from drivers.station import StationDriver
from drivers.station.make import (
    make_evcc,
    make_goe,
    make_http,
    make_ocpp,
    make_openevse,
    make_shelly,
    manage,
)
from drivers.station.memory import StationMemory
from drivers.station.settings import StationGroups
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits
from twin.statics import DEFAULT_TABLES, SagTables

D = TypeVar("D")

SIMULATOR = "simulator"
ARDUINO = "arduino"
NO_MANAGER = "none"


@dataclass(frozen=True)
class DeviceRequest:
    """What the drivers need to know.

    Attributes:
        robot: Name of the robot driver.
        camera: Name of the camera driver.
        station: Name of the station driver.
        port: Serial port of the motion board, "auto" to look for it.
        geometry: Calibrated geometry of the robot.
        limits: How fast its joints may move.
        mount: Where the camera sits.
        optics: Calibrated model of the camera.
        simulation: Numbers of the simulated garage.
        seed: Decides everything random in it.
        sag: How far the robot sags under its own weight.
        board: Numbers of the real motion board.
        cameras: How real cameras are reached.
        manager: Name of the energy manager before the station, or "none".
        stations: Settings of the stations.
        station_file: Where station and manager keep what must survive a restart; None keeps it
            in this process.
    """

    robot: str
    camera: str
    station: str
    port: str
    geometry: RobotGeometry
    limits: MotionLimits
    mount: CameraMount
    optics: CameraModel
    simulation: SimulationParameters
    seed: int
    sag: SagTables = DEFAULT_TABLES
    board: BoardSettings = field(default_factory=BoardSettings)
    cameras: CameraLinks = field(default_factory=CameraLinks)
    manager: str = NO_MANAGER
    stations: StationGroups = field(default_factory=StationGroups)
    station_file: Path | None = None

    @cached_property
    def memory(self) -> StationMemory:
        """What station and manager must not forget."""
        return StationMemory(self.station_file)

    @property
    def simulated(self) -> bool:
        """No real robot moves."""
        return self.robot == SIMULATOR

    @cached_property
    def garage(self) -> SimulatedGarage:
        """The one simulated garage that all simulated devices share with a simulated robot."""
        return build_garage(
            self.geometry,
            self.limits,
            self.mount,
            self.optics,
            parameters=self.simulation,
            seed=self.seed,
            sag=self.sag,
        )

    @cached_property
    def followed(self) -> FollowedGarage:
        """The one that they share around a real robot."""
        return build_followed_garage(
            self.geometry,
            self.limits,
            self.mount,
            self.optics,
            parameters=self.simulation,
            seed=self.seed,
            sag=self.sag,
        )

    @property
    def surroundings(self) -> SimulatedGarage | FollowedGarage:
        """Where the simulated camera and station are."""
        return self.garage if self.simulated else self.followed


ROBOTS: Mapping[str, Callable[[DeviceRequest], RobotDriver]] = {
    SIMULATOR: lambda request: request.garage.robot,
    ARDUINO: lambda request: ArduinoRobot(
        request.port, request.geometry, request.limits, request.board
    ),
}
CAMERAS: Mapping[str, Callable[[DeviceRequest], CameraDriver]] = {
    SIMULATOR: lambda request: request.surroundings.camera,
    "v4l2": lambda request: GrabbingCamera(
        V4l2Source(request.cameras.v4l2, request.optics), request.optics
    ),
    "picamera": lambda request: GrabbingCamera(
        PiCameraSource(request.cameras.picamera, request.optics), request.optics
    ),
    "stream": lambda request: GrabbingCamera(StreamSource(request.cameras.stream), request.optics),
    "replay": lambda request: GrabbingCamera(
        ReplaySource(request.cameras.replay), request.optics, moving=False
    ),
}
STATIONS: Mapping[str, Callable[[DeviceRequest], StationDriver]] = {
    SIMULATOR: lambda request: request.surroundings.station,
    "openevse": lambda request: make_openevse(request.stations, request.memory),
    "evcc": lambda request: make_evcc(request.stations, request.memory),
    "goe": lambda request: make_goe(request.stations, request.memory),
    "shelly": lambda request: make_shelly(request.stations),
    "http": lambda request: make_http(request.stations),
    "ocpp": lambda request: make_ocpp(request.stations, request.memory),
}


@dataclass(frozen=True, slots=True)
class Devices:
    """The drivers in use.

    Attributes:
        robot: The motion board.
        camera: The camera on the platform.
        station: The charging station.
        garage: The simulated garage with a simulated robot in it; None with a real robot.
        followed: The simulated garage around a real robot; None where nothing else is simulated,
            or everything. Its follower wants the telemetry of the robot.
    """

    robot: RobotDriver
    camera: CameraDriver
    station: StationDriver
    garage: SimulatedGarage | None
    followed: FollowedGarage | None = None

    @property
    def world(self) -> SimulatedWorld | None:
        """What simulated devices stand in; None without any."""
        around = self.garage or self.followed
        return around.world if around is not None else None


def make_devices(request: DeviceRequest) -> Devices:
    """Make the drivers that are asked for; nothing is opened yet.

    Raises:
        UnknownDriverError: there is no driver of one of the names.
    """
    around_real_robot = not request.simulated and SIMULATOR in {request.camera, request.station}
    return Devices(
        robot=_choose(ROBOTS, "robot", request.robot)(request),
        camera=_choose(CAMERAS, "camera", request.camera)(request),
        station=_station(request),
        garage=request.garage if request.simulated else None,
        followed=request.followed if around_real_robot else None,
    )


def _station(request: DeviceRequest) -> StationDriver:
    station = _choose(STATIONS, "station", request.station)(request)
    if request.manager == NO_MANAGER:
        return station
    return manage(request.manager, station, request.stations, request.memory)


def _choose(
    known: Mapping[str, Callable[[DeviceRequest], D]], kind: str, name: str
) -> Callable[[DeviceRequest], D]:
    try:
        return known[name]
    except KeyError:
        names = ", ".join(sorted(known))
        raise UnknownDriverError(
            f"There is no {kind} driver {name!r} in this version; there is: {names}."
        ) from None
