"""What a viewer can switch, on a real viser server."""

from __future__ import annotations

import subprocess
import sys

import pytest
import viser

from tests.twin.scene.conftest import build_scene
from tests.twin.scene.overlays.states import EVERYTHING
from twin.geometry import RobotGeometry
from twin.scene import viser_server
from twin.scene.overlays import CONDITION, OVERLAYS, PLACEMENTS, REGION, Overlay
from twin.scene.scene import TwinScene


def node(server: viser.ViserServer, name: str) -> viser.SceneNodeHandle:
    return server.scene._handle_from_node_name[name]


def names(server: viser.ViserServer) -> set[str]:
    return set(server.scene._handle_from_node_name)


def test_reading_the_list_loads_no_3d_library() -> None:
    code = "import sys, twin.scene.overlays; sys.exit('viser' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_names_are_unique() -> None:
    assert len({each.id for each in OVERLAYS}) == len(OVERLAYS)
    nodes = [name for each in OVERLAYS for name in each.nodes]
    assert len(set(nodes)) == len(nodes)


@pytest.mark.parametrize("overlay", OVERLAYS, ids=lambda each: each.id)
def test_its_nodes_are_there_and_shown_as_promised(
    overlay: Overlay, scene: TwinScene, server: viser.ViserServer
) -> None:
    assert scene
    for name in overlay.nodes:
        assert node(server, name).visible == overlay.shown_at_first
        assert any(other.startswith(f"{name}/") for other in names(server))


def test_a_robot_that_reaches_nothing_says_so(
    server: viser.ViserServer, caplog: pytest.LogCaptureFixture
) -> None:
    # The configuration refuses such legs; the picture must not draw them wrong either.
    build_scene(server, RobotGeometry().model_copy(update={"leg_length_mm": 120.0}))
    assert f"{REGION.nodes[0]}/none" in names(server)
    assert f"{REGION.nodes[0]}/outline" not in names(server)
    assert f"{CONDITION.nodes[0]}/map" not in names(server)
    assert "no workspace" in caplog.text


def test_a_box_that_fits_nowhere_says_so(server: viser.ViserServer) -> None:
    box = RobotGeometry().regular_box.model_copy(update={"width_mm": 900.0})
    build_scene(server, RobotGeometry(regular_box=box))
    assert f"{PLACEMENTS.nodes[0]}/none" in names(server)
    assert f"{REGION.nodes[0]}/outline" in names(server)


def test_nothing_is_sent_twice_for_the_same_state(
    scene: TwinScene, server: viser.ViserServer
) -> None:
    scene.show(EVERYTHING)
    counter = server._websock_server._broadcast_buffer
    before = counter.message_counter
    scene.show(EVERYTHING)
    assert counter.message_counter == before
    assert viser_server.watchers(server) == 0
