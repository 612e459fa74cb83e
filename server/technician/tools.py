"""The tools of the technician's page together, made by the composition root."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.camera import CameraDriver
from drivers.robot import RobotDriver
from server.config.settings import Settings
from server.control.jog import Jog
from server.control.supervisor import Supervisor
from server.control.targets import Targets
from server.storage.vehicles import VehicleStore
from server.technician.camera_inspection import CameraInspector
from server.technician.console import ProtocolConsole
from server.technician.link_report import LinkReporter
from server.technician.recent_log import RecentLog
from server.timing import Calendar

INSPECTION_PERIOD_S = 0.2
INSPECTION_PATIENCE_S = 3.0
CONSOLE_WAIT_S = 1.0
CONSOLE_PATIENCE_S = 5.0


@dataclass(frozen=True, slots=True)
class TechnicianTools:
    """What only the technician's page asks for.

    Attributes:
        camera: Looks closely at the camera's pictures.
        targets: Where somebody wants the robot to go.
        console: What goes over the link to the motion board.
        link: How well that link does.
        log: The newest lines of the log.
    """

    camera: CameraInspector
    targets: Targets
    console: ProtocolConsole
    link: LinkReporter
    log: RecentLog

    async def close(self) -> None:
        """End what is at work."""
        await self.camera.close()
        self.console.close()
        self.log.stop()


def make_tools(
    settings: Settings,
    calendar: Calendar,
    *,
    robot: RobotDriver,
    camera: CameraDriver,
    vehicles: VehicleStore,
    supervisor: Supervisor,
    jog: Jog,
) -> TechnicianTools:
    """Make all tools; none but the log is at work before somebody asks for it.

    Args:
        settings: The whole configuration.
        calendar: Dates.
        robot: The motion board.
        camera: On the robot.
        vehicles: Those that are known.
        supervisor: Owner of the robot.
        jog: Moves it for as long as somebody holds a button.
    """
    speed = settings.clock_speed
    log = RecentLog()
    log.start()
    return TechnicianTools(
        camera=CameraInspector(
            camera,
            settings.camera.optics,
            vehicles.all,
            calendar,
            period_s=INSPECTION_PERIOD_S * speed,
            patience_s=INSPECTION_PATIENCE_S * speed,
        ),
        targets=Targets(supervisor, jog),
        console=ProtocolConsole(
            robot, calendar, wait_s=CONSOLE_WAIT_S * speed, patience_s=CONSOLE_PATIENCE_S * speed
        ),
        link=LinkReporter(robot, supervisor.telemetry, calendar),
        log=log,
    )
