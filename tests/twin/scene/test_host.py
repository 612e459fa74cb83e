"""Starting, feeding and stopping the picture."""

from __future__ import annotations

import logging
import math
import socket
import subprocess
import sys
from collections.abc import Iterator

import pytest

from tests.support.twin_client import TwinClient
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene import TwinHost, TwinState, viser_server

HOME = JointPosition(200.0, 200.0, 60.0)


@pytest.fixture
def host(geometry: RobotGeometry) -> Iterator[TwinHost]:
    host = TwinHost(geometry, CameraMount(), math.radians(62.2), 4 / 3)
    yield host
    host.stop()


def address_of(host: TwinHost) -> str:
    assert host.wait_ready(20)
    return f"ws://127.0.0.1:{host.port}"


def test_importing_the_package_loads_no_3d_library() -> None:
    code = "import sys, twin.scene; sys.exit('viser' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_before_its_start_it_is_not_ready(host: TwinHost) -> None:
    host.publish(TwinState(measured=HOME))
    assert not host.ready
    assert host.port is None
    host.stop()


async def test_what_was_published_is_shown_newest_only(
    host: TwinHost, geometry: RobotGeometry
) -> None:
    host.start()
    host.start()  # a second start changes nothing
    for rho1 in range(100, 300):
        host.publish(TwinState(measured=HOME._replace(rho1_mm=rho1)))
    async with TwinClient.connected(address_of(host)) as client:
        last = JointPosition(299.0, 200.0, 60.0)
        x = gamma.platform(geometry, last).x_mm / 1000
        await client.until_position("/robot/platform", x)
        assert host.watching == 1
        moved = HOME._replace(rho2_mm=300)
        host.publish(TwinState(measured=moved))
        await client.until_position("/robot/platform", gamma.platform(geometry, moved).x_mm / 1000)
        assert client.visible["/robot"] is True


async def test_a_heartbeat_tells_a_browser_that_the_picture_lives(host: TwinHost) -> None:
    host.start()
    async with TwinClient.connected(address_of(host)) as client:
        beats: set[object] = set()
        while len(beats) < 5:
            await client.receive()
            beats.add(client.positions.get("/heartbeat"))


def test_stopping_closes_the_port_and_ends_the_thread(host: TwinHost) -> None:
    host.start()
    address_of(host)
    port = host.port
    assert port is not None
    host.stop()
    assert not host.ready
    assert host.port is None
    with pytest.raises(OSError, match="refused"), socket.socket() as probe:
        probe.connect(("127.0.0.1", port))


async def test_it_can_be_started_again(host: TwinHost, geometry: RobotGeometry) -> None:
    host.start()
    address_of(host)
    host.stop()
    host.publish(TwinState(measured=HOME))
    host.start()
    async with TwinClient.connected(address_of(host)) as client:
        await client.until_position("/robot/platform", gamma.platform(geometry, HOME).x_mm / 1000)


def test_a_picture_that_cannot_be_built_is_reported_and_harms_nobody(
    host: TwinHost, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def no_server() -> None:
        msg = "no port is free"
        raise OSError(msg)

    monkeypatch.setattr(viser_server, "open_server", no_server)
    with caplog.at_level(logging.ERROR):
        host.start()
        assert not host.wait_ready(0.5)
        host.stop()
    assert not host.ready
    assert "no port is free" in caplog.text
