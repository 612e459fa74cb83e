"""Feeds the 3D picture with what the robot does."""

from __future__ import annotations

from drivers.station import PilotState
from server.services import Services
from twin.scene import PlannedPath, TwinHost
from twin.scene.planned_path import Way
from twin.scene.state import TwinState


def feed_twin(services: Services, host: TwinHost) -> None:
    """Hand every change over to the picture, which shows the newest."""
    way = Way(services.supervisor.geometry)

    def publish() -> None:
        host.publish(twin_state(services, way.of(services.supervisor.plan)))

    services.supervisor.listen(publish)
    services.runner.listen(publish)


def twin_state(services: Services, path: PlannedPath | None = None) -> TwinState:
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
        parted=tuple(parted.quantity.value for parted in services.divergence.parted),
    )
