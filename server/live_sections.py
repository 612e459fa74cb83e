"""What everyone who watches sees: the live sections, and what makes each of them change."""

from __future__ import annotations

from server.calibration.view import calibration_view
from server.divergence.report import twin_report
from server.guidance.view import guidance_view
from server.live.control_view import control_view
from server.live.twin_feed import feed_twin
from server.live.views import robot_view, station_view
from server.schema.live import Queue, Service
from server.schema.problem import problem_from
from server.services import Services
from server.version import VERSION


def show(services: Services) -> None:
    """Connect what changes to those who watch."""
    live, supervisor, runner = services.live, services.supervisor, services.runner
    live.add("robot", lambda: robot_view(supervisor, runner.socket, services.calendar))
    live.add("control", lambda: control_view(services.seat))
    services.seat.listen(lambda: live.changed("control", urgent=True))
    live.add("job", lambda: runner.newest and services.recordings.show(runner.newest))
    live.add("queue", lambda: Queue(waiting=runner.waiting))
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
    services.database.listen(lambda: live.changed("service", urgent=True))
    live.add("twin", lambda: twin_report(services.divergence.parted, services.calendar))
    live.add(
        "guidance", lambda: guidance_view(services.guide, services.settings, services.calendar)
    )
    services.guide.listen(lambda: live.changed("guidance"))
    live.add("calibration", lambda: calibration_view(services.calibrations, services.measuring))
    services.calibrations.listen(lambda: live.changed("calibration", urgent=True))
    services.routines.listen(lambda: live.changed("calibration"))
    services.self_calibration.listen(lambda: live.changed("calibration"))
    services.divergence.listen(lambda _: live.changed("twin", urgent=True))
    live.add("outlook", services.outlook.shown)
    services.outlook.listen(lambda: live.changed("outlook"))

    shown: list[object] = [None]

    def robot_changed() -> None:
        what_matters = (supervisor.mode, supervisor.plug.state, supervisor.holder)
        live.changed("robot", urgent=what_matters != shown[0])
        shown[0] = what_matters

    def job_changed() -> None:
        live.changed("robot")
        live.changed("queue")
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
        storage=problem_from(problem) if (problem := services.database.problem) else None,
    )
