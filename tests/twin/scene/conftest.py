"""A scene on a real viser server that nobody watches."""

from __future__ import annotations

import math
from collections.abc import Iterator

import pytest
import viser

from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import viser_server
from twin.scene.scene import TwinScene
from twin.statics import ActuatorLimits, Loads, SagTables


@pytest.fixture
def server() -> Iterator[viser.ViserServer]:
    server = viser_server.open_server()
    yield server
    server.stop()


@pytest.fixture(scope="session")
def geometry() -> RobotGeometry:
    return RobotGeometry()


@pytest.fixture
def scene(server: viser.ViserServer, geometry: RobotGeometry) -> TwinScene:
    return build_scene(server, geometry)


def build_scene(server: viser.ViserServer, geometry: RobotGeometry) -> TwinScene:
    """The scene of any robot with everything else as published."""
    return TwinScene(
        server.scene,
        geometry,
        CameraMount(),
        hfov_rad=math.radians(62.2),
        aspect=4 / 3,
        loads=Loads(),
        limits=ActuatorLimits(),
        sag=SagTables(),
    )
