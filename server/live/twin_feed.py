"""Feeds the 3D picture with what the robot does."""

from __future__ import annotations

from drivers.station import PilotState
from server.services import Services
from twin.scene import PlannedPath, TwinHost
from twin.scene.planned_path import Way
from twin.scene.state import ChosenTarget, TwinState


def feed_twin(services: Services, host: TwinHost) -> None:
    """Hand every change over to the picture, which shows the newest."""
    geometry, targets = services.supervisor.geometry, services.technician.targets
    way, way_to_target = Way(geometry), Way(geometry)
    shown: list[ChosenTarget | None] = [None]

    def publish() -> None:
        target = targets.target
        path = way_to_target.of(target.plan if target else None)
        if target is None or path is None:
            shown[0] = None
        elif shown[0] is None or shown[0].path is not path:
            shown[0] = ChosenTarget(target.plan.end.position, path)
        host.publish(twin_state(services, way.of(services.supervisor.plan), shown[0]))

    services.supervisor.listen(publish)
    services.technician.targets.listen(publish)
    services.runner.listen(publish)


def twin_state(
    services: Services, path: PlannedPath | None = None, target: ChosenTarget | None = None
) -> TwinState:
    """What the picture shows now."""
    supervisor, socket = services.supervisor, services.runner.socket
    state = supervisor.telemetry.latest
    station = services.station.snapshot
    return TwinState(
        measured=state.measured.position if state else None,
        commanded=state.commanded.position if state else None,
        force_n=state.force_n if state else 0.0,
        plug=supervisor.plug.state.value,
        mode=supervisor.mode.value,
        charging=station is not None and station.pilot in {PilotState.C, PilotState.D},
        T_base_socket=socket.T_base_socket if socket else None,
        T_base_label=socket.T_base_label if socket else None,
        socket_covariance_mm2=socket.covariance if socket else None,
        path=path,
        target=target,
        parted=tuple(parted.quantity.value for parted in services.divergence.parted),
    )
