"""The ghost of the robot at a chosen place."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.twin.scene.overlays.states import EVERYTHING, PATH
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.scene.poses import robot_pose
from twin.scene.scene import TwinScene
from twin.scene.state import ChosenTarget

THERE = JointPosition(240.0, 180.0, 90.0)
CHOSEN = replace(EVERYTHING, target=ChosenTarget(THERE, PATH))


def test_it_stands_where_the_robot_would_stand(scene: TwinScene) -> None:
    scene.show(CHOSEN)
    pose = robot_pose(RobotGeometry(), THERE)
    ghost = scene.target.ghost
    assert ghost is not None
    assert ghost.whole.visible
    assert ghost.platform.position == pytest.approx([each / 1000 for each in pose.v])
    assert ghost.plug.position == pytest.approx([each / 1000 for each in pose.plug])
    assert scene.target.path.end.text == "4.0 s, 160 mm"
    assert scene.robot.platform.position != pytest.approx(ghost.platform.position)


def test_it_goes_when_nobody_wants_to_go_there(scene: TwinScene) -> None:
    scene.show(CHOSEN)
    scene.show(EVERYTHING)
    assert scene.target.ghost is not None
    assert not scene.target.ghost.whole.visible
    assert not scene.target.path.way.visible


def test_a_place_without_a_pose_has_no_ghost(scene: TwinScene) -> None:
    scene.show(replace(EVERYTHING, target=ChosenTarget(JointPosition(-900.0, 900.0, 90.0), PATH)))
    assert scene.target.ghost is None, "nor has any browser got its shapes"
