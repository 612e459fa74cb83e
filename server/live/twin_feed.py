"""Feeds the 3D picture with what the robot does."""

from __future__ import annotations

import numpy as np

from drivers.station import PilotState
from server.services import Services
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import KinematicsError, gamma
from twin.motion import MotionPlan
from twin.scene import PlannedPath, TwinHost
from twin.scene.state import TwinState

_SAMPLES = 81


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


class Way:
    """The way of the plug's tip for the plan that is followed, worked out once for each plan."""

    def __init__(self, geometry: RobotGeometry) -> None:
        self._geometry = geometry
        self._plan: MotionPlan | None = None
        self._path: PlannedPath | None = None

    def of(self, plan: MotionPlan | None) -> PlannedPath | None:
        """The path of a plan: the same object as long as it is the same plan."""
        if plan is not self._plan:
            self._plan = plan
            self._path = None if plan is None else planned_path(self._geometry, plan)
        return self._path


def planned_path(geometry: RobotGeometry, plan: MotionPlan) -> PlannedPath | None:
    """Where the tip goes; None if nothing moves, or the plan has joints without a pose."""
    if plan.duration_s <= 0:
        return None
    times_s = np.linspace(0.0, plan.duration_s, _SAMPLES)
    joints = plan.sample(times_s).position_mm
    try:
        tips = [gamma.forward(geometry, JointPosition(*map(float, row))) for row in joints]
    except KinematicsError:
        return None
    return PlannedPath(times_s, np.array(tips))
