"""The nodes of the robot on a real viser server, against the kinematics."""

from __future__ import annotations

import logging

import numpy as np
import pytest
from numpy.typing import NDArray
from viser import SceneNodeHandle
from viser.transforms import SO3

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.scene import plug_parts, room
from twin.scene.scene import TwinScene
from twin.scene.state import TwinState

HOME = JointPosition(200.0, 200.0, 60.0)


def is_visible(node: SceneNodeHandle) -> bool:
    return node.visible


def at_mm(node: SceneNodeHandle) -> NDArray[np.float64]:
    return np.asarray(node.position) * 1000


def point_mm(
    node: SceneNodeHandle,
    local_mm: tuple[float, float, float],
    on: SceneNodeHandle | None = None,
) -> NDArray[np.float64]:
    """A point of a node, which hangs on the root or on an unturned node, in the base frame."""
    parent = np.zeros(3) if on is None else at_mm(on)
    return parent + at_mm(node) + SO3(np.asarray(node.wxyz)).as_matrix() @ local_mm


def links(scene: TwinScene) -> NDArray[np.float32]:
    """Middles of the cable's links [m]."""
    return np.array(scene.robot.cable.node.batched_positions)


def outlet_mm(scene: TwinScene) -> NDArray[np.float64]:
    """Where the cable leaves the plug, in the base frame."""
    plug = scene.robot.plug
    return point_mm(plug, tuple(plug_parts.cable_outlet_mm()), scene.robot.platform)


def test_bars_platform_and_plug_follow_the_joints(
    scene: TwinScene, geometry: RobotGeometry
) -> None:
    g, nodes = geometry, scene.robot
    random = np.random.default_rng(7)
    half, length = g.platform_width_mm / 2, g.leg_length_mm
    for _ in range(40):
        joints = JointPosition(*(random.uniform(r.min_mm, r.max_mm) for r in g.joint_ranges))
        scene.show(TwinState(measured=joints))
        x, y = gamma.platform(g, joints)
        left = (g.e1x_mm + joints.rho1_mm, g.e1y_mm, 0)
        right = (g.base_width_mm - g.e2x_mm - joints.rho2_mm, g.e2y_mm, 0)

        # Nodes are moved unless viser finds the new pose equal to the old to 1e-5.
        assert at_mm(nodes.left_carriage) == pytest.approx(left, abs=1e-6, rel=0)
        assert at_mm(nodes.right_carriage) == pytest.approx(right, abs=1e-6, rel=0)
        foot = point_mm(nodes.left_carriage, (half, g.e_py_mm, 0))
        for bar, carriage, pivot, end in (
            (nodes.bar_ab, nodes.left_carriage, left, (x - half, y, 0)),
            (nodes.bar_df, nodes.left_carriage, foot, (x, y + g.e_py_mm, 0)),
            (nodes.bar_ec, nodes.right_carriage, right, (x + half, y, 0)),
        ):
            assert bar.name.startswith(f"{carriage.name}/")
            assert point_mm(bar, (0, 0, 0), carriage) == pytest.approx(pivot, abs=1e-6, rel=0)
            assert point_mm(bar, (length, 0, 0), carriage) == pytest.approx(end, abs=1e-6, rel=0)
        assert at_mm(nodes.platform) == pytest.approx((x, y, 0), abs=1e-6, rel=0)
        tip = at_mm(nodes.platform) + at_mm(nodes.plug)
        assert tip == pytest.approx(tuple(gamma.forward(g, joints)), abs=1e-6, rel=0)
        ahead = SO3(np.asarray(nodes.plug.wxyz)).as_matrix()[:, 2]
        assert ahead == pytest.approx(g.insertion_axis)


def test_the_cable_runs_from_the_station_to_the_plug(
    scene: TwinScene, geometry: RobotGeometry
) -> None:
    scene.show(TwinState(measured=HOME))
    middles = links(scene) * 1000
    half_link = 1500 / len(middles) / 2
    start, end = room.cable_inlet_mm(geometry), outlet_mm(scene)
    assert np.linalg.norm(middles[0] - start) == pytest.approx(half_link, abs=0.5)
    assert np.linalg.norm(middles[-1] - end) == pytest.approx(half_link, abs=0.5)
    assert middles[:, 1].min() < min(start[1], end[1]) - 100
    assert middles[:, 1].min() > -330  # above the floor


def test_a_plug_that_stands_still_sends_no_cable(scene: TwinScene) -> None:
    scene.show(TwinState(measured=HOME))
    before = links(scene)
    scene.show(TwinState(measured=HOME._replace(rho3_mm=HOME.rho3_mm + 0.1)))
    scene.animate(0.0)
    assert (links(scene) == before).all()
    scene.show(TwinState(measured=HOME._replace(rho3_mm=HOME.rho3_mm + 1)))
    scene.animate(0.1)
    assert (links(scene) != before).any()


def test_the_cable_follows_every_other_step_and_ends_where_the_plug_stopped(
    scene: TwinScene,
) -> None:
    drawn: set[bytes] = set()
    for step in range(31):
        scene.show(TwinState(measured=HOME._replace(rho3_mm=60.0 + step)))
        scene.animate(step / 30)
        drawn.add(links(scene).tobytes())
    assert 15 <= len(drawn) <= 17
    scene.animate(2.0)
    arrived = links(scene)
    scene.show(TwinState(measured=HOME._replace(rho3_mm=90.0)))
    scene.animate(3.0)
    assert (links(scene) == arrived).all()
    behind = np.linalg.norm(arrived[-1] * 1000 - outlet_mm(scene))
    assert behind == pytest.approx(1500 / len(arrived) / 2, abs=0.5)


def test_a_robot_that_knows_no_position_is_not_shown(scene: TwinScene) -> None:
    assert not is_visible(scene.robot.robot)
    scene.show(TwinState(measured=HOME, commanded=HOME._replace(rho1_mm=240)))
    assert is_visible(scene.robot.robot)
    assert is_visible(scene.robot.cable.node)
    assert is_visible(scene.robot.ghost)
    scene.show(TwinState(commanded=HOME))
    assert not is_visible(scene.robot.robot)
    assert not is_visible(scene.robot.cable.node)
    assert not is_visible(scene.robot.ghost)


def test_joints_without_a_pose_hide_the_robot_and_are_reported_once(
    scene: TwinScene, caplog: pytest.LogCaptureFixture
) -> None:
    impossible = JointPosition(-400.0, -400.0, 60.0)
    with caplog.at_level(logging.WARNING):
        scene.show(TwinState(measured=impossible))
        scene.show(TwinState(measured=impossible, force_n=1))
    assert not is_visible(scene.robot.robot)
    assert len(caplog.records) == 1
    assert is_visible(scene.notice)
    assert "No pose" in scene.notice.text
    scene.show(TwinState(measured=HOME))
    assert is_visible(scene.robot.robot)
    assert not is_visible(scene.notice)


def test_a_joint_outside_its_range_is_named(scene: TwinScene) -> None:
    scene.show(TwinState(measured=JointPosition(432.0, 419.0, 60.0)))
    assert is_visible(scene.notice)
    assert scene.notice.text == "rho1 is 12 mm outside its range"


def test_the_ghost_shows_where_a_parted_plug_should_be(
    scene: TwinScene, geometry: RobotGeometry
) -> None:
    near, far = HOME._replace(rho3_mm=63.0), HOME._replace(rho3_mm=68.0)
    scene.show(TwinState(measured=HOME, commanded=near))
    assert not is_visible(scene.robot.ghost)
    scene.show(TwinState(measured=HOME, commanded=far))
    assert is_visible(scene.robot.ghost)
    assert at_mm(scene.robot.ghost) == pytest.approx(tuple(gamma.forward(geometry, far)), abs=1e-6)


def test_light_runs_along_the_cable_only_while_charging(scene: TwinScene) -> None:
    node = scene.robot.cable.node
    dark = np.asarray(node.batched_colors).copy()
    scene.show(TwinState(measured=HOME, charging=True))
    seen: set[bytes] = set()
    for step in range(6):
        scene.animate(step / 10)
        seen.add(np.asarray(node.batched_colors).tobytes())
    assert len(seen) >= 3
    scene.show(TwinState(measured=HOME))
    scene.animate(0.7)
    assert (np.asarray(node.batched_colors) == dark).all()
