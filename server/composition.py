"""The composition root: the only place where the parts are wired together."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import AsyncIterator
from pathlib import Path

import cv2

from drivers.camera import CameraError
from drivers.errors import UnknownDriverError
from drivers.registry import SIMULATOR, DeviceRequest, Devices, make_devices
from drivers.simulator.car import ParkedCar
from drivers.simulator.following import RobotFollower
from drivers.station import StationError
from server.config.errors import ConfigurationError
from server.config.settings import Settings
from server.control.jog import DEAD_MAN_S, Jog
from server.control.supervisor import Supervisor
from server.jobs.runner import JobRunner
from server.live.camera_feed import CameraFeed
from server.live.hub import LiveHub
from server.live.station_watch import StationWatch
from server.live.twin_feed import feed_twin
from server.live.views import robot_view, station_view
from server.localisation.eye import Eye
from server.schema.live import Service
from server.schema.vehicles import SocketOffset, VehicleSettings
from server.services import Services
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.vehicles import VehicleStore
from server.timing import Calendar
from server.version import VERSION
from twin.scene import TwinHost

_log = logging.getLogger(__name__)

PUSH_PERIOD_S = 0.05
STATION_PERIOD_S = 1.0
CAMERA_PERIOD_S = 0.2
DEMO_NAME = "Demo car"


class DriverChoiceError(ConfigurationError):
    """The configuration names a driver that does not exist."""

    code = "unknown_driver"
    title = "There is no such driver"


@contextlib.asynccontextmanager
async def running(
    settings: Settings,
    *,
    folder: Path | None,
    devices: Devices | None = None,
    twin: TwinHost | None = None,
    wait_for_robot: bool = True,
) -> AsyncIterator[Services]:
    """Start everything, and stop it in the opposite order.

    Args:
        settings: The whole configuration.
        folder: Where data is kept; None keeps it in memory.
        devices: To be used in place of those that the settings name.
        twin: The 3D picture to feed, if any; started by the caller.
        wait_for_robot: Be ready only after the first attempt to reach the motion board. Pages
            need not wait for that: a board takes a second to start.

    Raises:
        ConfigurationError: a driver does not exist.
        StorageError: the data folder or the database cannot be used.
    """
    # One thread: on a Raspberry Pi the other cores belong to the robot, the pages and the twin.
    cv2.setNumThreads(1)
    speed = settings.clock_speed
    calendar = Calendar(speed)
    devices = devices or _devices(settings, folder)
    async with contextlib.AsyncExitStack() as stack:
        database = Database(folder)
        await database.open()
        stack.push_async_callback(database.close)
        jobs, vehicles = JobStore(database), VehicleStore(database)

        await _open(devices, stack)
        if devices.world is not None and settings.camera.driver == SIMULATOR:
            await _introduce(devices.world.car, vehicles)

        supervisor = Supervisor(
            devices.robot, settings.geometry, settings.motion, StoredPlug(database), calendar
        )
        if devices.followed is not None:
            _let_follow(devices.followed.follower, supervisor)
        runner = JobRunner(
            supervisor=supervisor,
            eye=Eye(
                devices.camera,
                settings.camera.optics,
                settings.camera.mount,
                settings.geometry,
                supervisor.telemetry,
            ),
            station=devices.station,
            jobs=jobs,
            vehicles=vehicles,
            settings=settings,
            calendar=calendar,
        )
        camera = CameraFeed(devices.camera, CAMERA_PERIOD_S * speed)
        stack.push_async_callback(camera.close)
        live = LiveHub(PUSH_PERIOD_S * speed)
        services = Services(
            settings=settings,
            calendar=calendar,
            started_at=calendar.now(),
            database=database,
            jobs=jobs,
            vehicles=vehicles,
            supervisor=supervisor,
            jog=Jog(supervisor, DEAD_MAN_S * speed),
            runner=runner,
            station=StationWatch(
                devices.station, STATION_PERIOD_S * speed, lambda: live.changed("station")
            ),
            camera=camera,
            live=live,
            twin=twin,
            garage=devices.garage,
        )
        _show(services)
        await supervisor.start(wait=wait_for_robot)
        stack.push_async_callback(supervisor.close)
        await runner.start()
        stack.push_async_callback(runner.close)
        await services.station.start()
        stack.push_async_callback(services.station.close)
        yield services


def _devices(settings: Settings, folder: Path | None) -> Devices:
    request = DeviceRequest(
        robot=settings.robot.driver,
        camera=settings.camera.driver,
        station=settings.station.driver,
        port=settings.robot.port,
        board=settings.robot.board,
        manager=settings.station.manager,
        stations=settings.station,
        station_file=folder / "station.json" if folder is not None else None,
        geometry=settings.geometry,
        limits=settings.motion,
        mount=settings.camera.mount,
        optics=settings.camera.optics,
        simulation=settings.simulation.parameters,
        seed=settings.simulation.seed,
    )
    try:
        return make_devices(request)
    except UnknownDriverError as error:
        raise DriverChoiceError(str(error)) from error


async def _open(devices: Devices, stack: contextlib.AsyncExitStack) -> None:
    """Open camera and station. One that is down is shown as down; the robot can still be used."""
    stack.push_async_callback(devices.camera.close)
    stack.push_async_callback(devices.station.close)
    try:
        await devices.camera.open()
    except CameraError as error:
        _log.warning("the camera is down: %s", error)
    try:
        await devices.station.open()
    except StationError as error:
        _log.warning("the charging station is down: %s", error)


async def _introduce(car: ParkedCar, vehicles: VehicleStore) -> None:
    """Make the simulated car known, as its owner would have measured it.

    Done at every start: another seed is another car with the same label.
    """
    offset = car.known_offset
    await vehicles.put(
        car.payload.rsplit(":", 1)[-1],
        VehicleSettings(
            name=DEMO_NAME,
            label_size_mm=car.label_size_mm,
            socket=SocketOffset(
                x_mm=offset.x_mm,
                y_mm=offset.y_mm,
                z_mm=offset.z_mm,
                rotation_x_rad=offset.rotation_x_rad,
                rotation_y_rad=offset.rotation_y_rad,
            ),
        ),
    )


def _let_follow(follower: RobotFollower, supervisor: Supervisor) -> None:
    """Let the simulated surroundings of a real robot know where it stands."""

    def pass_on() -> None:
        state = supervisor.telemetry.latest
        if state is not None:
            follower.take(state)

    supervisor.listen(pass_on)


def _show(services: Services) -> None:
    """Connect what changes to those who watch."""
    live, supervisor, runner = services.live, services.supervisor, services.runner
    live.add("robot", lambda: robot_view(supervisor, runner.socket, services.calendar))
    live.add("job", lambda: runner.newest)
    live.add(
        "station",
        lambda: station_view(
            services.station.name,
            services.station.snapshot,
            online=services.station.online,
            calendar=services.calendar,
        ),
    )
    live.add("service", lambda: _service(services))

    shown: list[object] = [None]

    def robot_changed() -> None:
        what_matters = (supervisor.mode, supervisor.plug.state, supervisor.holder)
        live.changed("robot", urgent=what_matters != shown[0])
        shown[0] = what_matters

    def job_changed() -> None:
        live.changed("robot")
        live.changed("job", urgent=True)

    supervisor.listen(robot_changed)
    runner.listen(job_changed)
    if services.twin is not None:
        feed_twin(services, services.twin)


def _service(services: Services) -> Service:
    return Service(
        version=VERSION,
        simulated=services.settings.simulated,
        simulated_parts=services.settings.simulated_parts,
        speed=services.settings.clock_speed,
        camera_online=services.camera.online,
        started_at=services.started_at,
    )
