"""The composition root: the only place where the parts are wired together."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import AsyncIterator
from pathlib import Path

import cv2
from threadpoolctl import threadpool_limits

from drivers.camera import CameraError
from drivers.errors import UnknownDriverError
from drivers.registry import SIMULATOR, DeviceRequest, Devices, make_devices
from drivers.station import StationError
from server.access import Access
from server.calibration.measuring import Measuring
from server.calibration.versions.service import Calibrations
from server.config.errors import ConfigurationError
from server.config.forces import loads_at_limits
from server.config.settings import Settings
from server.config.storage import StorageSettings
from server.control.built_robot import BuiltRobot
from server.control.jog import DEAD_MAN_S, Jog
from server.control.path_check import Strength
from server.control.seat import ANSWER_S, HOLD_S, ControlSeat
from server.control.supervisor import Supervisor
from server.control_trail import note_control
from server.divergence import DivergenceWatcher
from server.guidance.guide import Guide
from server.integrations import Integrations
from server.jobs.outlook.watch import OutlookWatch
from server.jobs.runner import JobRunner
from server.labels.key_file import load_label_key
from server.labels.payload import LabelKey
from server.live.camera_feed import CameraFeed
from server.live.hub import LiveHub
from server.live.station_watch import StationWatch
from server.live_sections import show
from server.localisation.eye import Eye
from server.recordings.playbacks import Playbacks
from server.recordings.recorder import Recorder
from server.recordings.store import RecordingStore
from server.services import Services
from server.simulated_garage import introduce, let_follow, simulated_car, simulated_hand
from server.storage.daily_backups import DailyBackups
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.vehicles import VehicleStore
from server.technician.tools import make_tools
from server.timing import Calendar
from twin.scene import TwinHost

_log = logging.getLogger(__name__)

PUSH_PERIOD_S = 0.05
STATION_PERIOD_S = 1.0
CAMERA_PERIOD_S = 0.2


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
    _compute_in_one_thread()
    speed = settings.clock_speed
    calendar = Calendar(speed)
    devices = devices or _devices(settings, folder)
    async with contextlib.AsyncExitStack() as stack:
        database = await _opened(settings.storage, folder, calendar, stack)
        access = await _let_in(Access(database, calendar, settings.access, speed), stack)
        calibrations = Calibrations(database, settings, calendar)
        await calibrations.start()
        known = calibrations.in_force
        jobs, vehicles = JobStore(database), VehicleStore(database, _label_key(settings, folder))

        await _open(devices, stack)
        if devices.world is not None and settings.camera.driver == SIMULATOR:
            await introduce(devices.world, vehicles)

        supervisor = Supervisor(
            devices.robot,
            settings.geometry,
            settings.motion,
            StoredPlug(database, folder),
            calendar,
            station=devices.station,
            settings=settings.supervision,
            strength=Strength(
                loads_at_limits(settings.loads, settings.insertion), settings.actuators
            ),
            built=BuiltRobot.of(settings.geometry, known.mechanism, known.force_scale),
        )
        let_follow(devices, supervisor)
        eye = Eye(
            devices.camera,
            known.known_camera(settings.camera),
            settings.geometry,
            supervisor.telemetry,
        )
        runner = JobRunner(
            supervisor=supervisor,
            eye=eye,
            station=devices.station,
            jobs=jobs,
            vehicles=vehicles,
            settings=settings,
            calendar=calendar,
            as_taught=calibrations.as_taught,
        )
        outlook = OutlookWatch(
            runner=runner, supervisor=supervisor, jobs=jobs, settings=settings, calendar=calendar
        )
        measuring = Measuring.of(
            database,
            supervisor=supervisor,
            eye=eye,
            runner=runner,
            vehicles=vehicles,
            calibrations=calibrations,
            settings=settings,
            calendar=calendar,
        )
        integrations = Integrations(database, settings, calendar, speed)
        await integrations.running_settings.start()
        camera = CameraFeed(devices.camera, CAMERA_PERIOD_S * speed)
        stack.push_async_callback(camera.close)
        live = LiveHub(PUSH_PERIOD_S * speed)
        divergence = DivergenceWatcher(
            supervisor, runner, eye, settings.divergence.for_clock(speed)
        )
        stack.push_async_callback(divergence.close)

        guide = Guide(
            devices.camera,
            supervisor,
            vehicles,
            settings,
            watched=lambda: live.watchers > 0,
            speed=speed,
        )
        calibrations.apply_to(supervisor, eye, guide)

        def station_read() -> None:
            recorder.station_changed()
            charge_point.station_read()
            outlook.station_read(station.snapshot if station.online else None)
            live.changed("station")

        station = StationWatch(devices.station, STATION_PERIOD_S * speed, station_read)
        charge_point = integrations.charge_point(
            supervisor=supervisor, runner=runner, station=devices.station, watch=station
        )
        recordings = RecordingStore(folder, settings.recordings)
        recorder = Recorder(
            store=recordings,
            settings=settings,
            calendar=calendar,
            supervisor=supervisor,
            runner=runner,
            eye=eye,
            station=station,
            divergence=divergence,
            finished=lambda _: live.changed("job"),
        )
        recorder.start()
        stack.push_async_callback(recorder.close)
        jog = Jog(supervisor, DEAD_MAN_S * speed)
        technician = make_tools(
            settings,
            calendar,
            robot=devices.robot,
            camera=devices.camera,
            vehicles=vehicles,
            supervisor=supervisor,
            jog=jog,
        )
        stack.push_async_callback(technician.close)
        services = Services(
            settings=settings,
            calendar=calendar,
            started_at=calendar.now(),
            database=database,
            access=access,
            jobs=jobs,
            vehicles=vehicles,
            supervisor=supervisor,
            jog=jog,
            seat=ControlSeat(
                supervisor, jog, calendar, hold_s=HOLD_S * speed, answer_s=ANSWER_S * speed
            ),
            runner=runner,
            outlook=outlook,
            station=station,
            camera=camera,
            live=live,
            calibrations=calibrations,
            measuring=measuring,
            divergence=divergence,
            guide=guide,
            recordings=recordings,
            playbacks=Playbacks(recordings, settings.recordings),
            running_settings=integrations.running_settings,
            events=integrations.events,
            webhooks=integrations.webhooks,
            push=integrations.push(access, settings.push),
            charge_point=charge_point,
            twin=twin,
            garage=devices.garage,
            simulated_car=simulated_car(devices, settings),
            simulated_hand=simulated_hand(devices),
            technician=technician,
        )
        show(services)
        note_control(services)
        integrations.tell_events(services)
        await _start(services, stack, wait_for_robot=wait_for_robot)
        yield services


def _compute_in_one_thread() -> None:
    """On a Raspberry Pi the other cores belong to the robot, the pages and the twin."""
    cv2.setNumThreads(1)
    threadpool_limits(1, "blas")


async def _opened(
    settings: StorageSettings,
    folder: Path | None,
    calendar: Calendar,
    stack: contextlib.AsyncExitStack,
) -> Database:
    url = settings.url.get_secret_value() if settings.url else None
    database = Database(folder, url=url, backups_kept=settings.backups_kept)
    await database.open()
    stack.push_async_callback(database.close)
    backups = DailyBackups(database, calendar)
    backups.start()
    stack.push_async_callback(backups.close)
    return database


async def _let_in(access: Access, stack: contextlib.AsyncExitStack) -> Access:
    await access.start()
    stack.push_async_callback(access.close)
    return access


async def _start(
    services: Services, stack: contextlib.AsyncExitStack, *, wait_for_robot: bool
) -> None:
    """Set everything going that does something by itself."""
    await services.webhooks.start()
    stack.push_async_callback(services.webhooks.close)
    await services.push.start()
    stack.push_async_callback(services.push.close)
    await services.charge_point.start()
    stack.push_async_callback(services.charge_point.close)
    await services.supervisor.start(wait=wait_for_robot)
    stack.push_async_callback(services.supervisor.close)
    await services.measuring.start()
    stack.push_async_callback(services.measuring.close)
    await services.outlook.start()
    await services.runner.start()
    stack.push_async_callback(services.runner.close)
    await services.station.start()
    stack.push_async_callback(services.station.close)
    await services.guide.start()
    stack.push_async_callback(services.guide.close)


def _devices(settings: Settings, folder: Path | None) -> Devices:
    request = DeviceRequest(
        robot=settings.robot.driver,
        camera=settings.camera.driver,
        station=settings.station.driver,
        port=settings.robot.port,
        board=settings.robot.board,
        cameras=settings.camera.link,
        manager=settings.station.manager,
        stations=settings.station,
        station_file=folder / "station.json" if folder is not None else None,
        geometry=settings.geometry,
        limits=settings.motion,
        mount=settings.camera.mount,
        optics=settings.camera.optics,
        sag=settings.sag,
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


def _label_key(settings: Settings, folder: Path | None) -> LabelKey:
    """The key of this installation; without a folder one that the seed repeats."""
    if folder is not None:
        return load_label_key(folder)
    return LabelKey(settings.simulation.seed.to_bytes(16, "big"))
