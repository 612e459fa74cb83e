"""Forces as arrows, against statics."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from viser.transforms import SO3

from tests.twin.scene.overlays.states import EVERYTHING
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.scene import TwinState
from twin.scene.overlays.colors import GOOD_TO_BAD
from twin.scene.overlays.forces import ARROW_MM_PER_N, ForceArrow, carried_forces, utilisation_color
from twin.scene.scene import TwinScene
from twin.statics import LoadCase, Loads, actuator_loads

LOADS = Loads()
SYMMETRIC = JointPosition(200.0, 200.0, 100.0)


def length_n(arrow: ForceArrow) -> float:
    return float(np.asarray(arrow.arrow.scale)[2]) * 1000 / ARROW_MM_PER_N


def test_small_forces_have_no_arrow(scene: TwinScene) -> None:
    scene.show(TwinState(measured=SYMMETRIC, force_n=1.0))
    assert not scene.forces.insertion.pivot.visible
    assert scene.forces.left.pivot.visible  # it holds the weight


def test_before_its_first_force_an_arrow_is_no_longer_than_wide(scene: TwinScene) -> None:
    assert max(np.asarray(scene.forces.left.arrow.scale)) < 0.01


def test_the_plug_is_pushed_back_along_its_axis(scene: TwinScene) -> None:
    scene.show(TwinState(measured=SYMMETRIC, force_n=70.4))
    assert scene.forces.insertion.pivot.visible
    assert length_n(scene.forces.insertion) == pytest.approx(-70)
    assert scene.forces.insertion.label.text == "plug 70 of 70 N"
    scene.show(TwinState(measured=SYMMETRIC, force_n=-20.0))
    assert length_n(scene.forces.insertion) == pytest.approx(20)


def test_carriages_carry_what_virtual_work_says(geometry: RobotGeometry) -> None:
    state = TwinState(measured=SYMMETRIC, force_n=70.0)
    forces = carried_forces(geometry, LOADS, state)
    assert forces == pytest.approx(actuator_loads(geometry, SYMMETRIC, LOADS, LoadCase.INSERTING))
    # In the symmetric pose a pure fy asks fy d / (2 h) of each carriage.
    d = (geometry.base_width_mm - 2 * geometry.e1x_mm - 400.0 - geometry.platform_width_mm) / 2
    h = math.sqrt(geometry.leg_length_mm**2 - d**2)
    fy = 70.0 * math.sin(geometry.theta_rad) + 9.80665 * (2.0 + 1.0 + 0.5 * 1.4 + 1.5 * 0.3)
    assert forces.rho1_n == pytest.approx(fy * d / (2 * h))
    assert forces.rho2_n == pytest.approx(fy * d / (2 * h))


def test_colours_run_to_red_at_the_limit(scene: TwinScene) -> None:
    assert utilisation_color(0.0) == GOOD_TO_BAD[0]
    assert utilisation_color(1.0) == utilisation_color(1.7) == GOOD_TO_BAD[-1]
    scene.show(TwinState(measured=SYMMETRIC, force_n=70.0))
    assert tuple(scene.forces.insertion.arrow.color) == GOOD_TO_BAD[-1]
    scene.show(TwinState(measured=SYMMETRIC, force_n=35.0))
    assert tuple(scene.forces.insertion.arrow.color) == GOOD_TO_BAD[2]
    share = scene.forces.left._shown_n
    assert share is not None
    assert tuple(scene.forces.left.arrow.color) == utilisation_color(share / 100)
    assert scene.forces.left.label.text == f"rho1 {share} of 100 N"


def test_carriage_arrows_point_along_the_rail(scene: TwinScene, geometry: RobotGeometry) -> None:
    state = TwinState(measured=JointPosition(300.0, 300.0, 100.0), force_n=-200.0)
    forces = carried_forces(geometry, LOADS, state)
    scene.show(state)
    for arrow, along_x_n in (
        (scene.forces.left, forces.rho1_n),
        (scene.forces.right, -forces.rho2_n),
    ):
        assert arrow.pivot.visible
        assert length_n(arrow) == pytest.approx(round(along_x_n))
        axis = SO3(np.asarray(arrow.pivot.wxyz)).as_matrix()[:, 2]
        assert axis == pytest.approx([1, 0, 0], abs=1e-9)


def test_nothing_is_carried_by_a_robot_that_nobody_knows(geometry: RobotGeometry) -> None:
    assert carried_forces(geometry, LOADS, TwinState(force_n=70.0)) == (0, 0, 0)
    nowhere = TwinState(measured=JointPosition(-400.0, -400.0, 60.0), force_n=70.0)
    assert carried_forces(geometry, LOADS, nowhere) == (0, 0, 0)


def test_the_cable_pulls_down_and_towards_the_station(scene: TwinScene) -> None:
    scene.show(EVERYTHING)
    pull = scene.robot.cable.pull_n
    assert pull is not None
    assert pull[1] < -3
    assert pull[0] > 0  # the station hangs at the right end of the rail
    size = float(np.linalg.norm(pull))
    assert length_n(scene.forces.cable) == pytest.approx(round(size))
    plug = SO3(np.asarray(scene.robot.plug.wxyz)).as_matrix()
    arrow = SO3(np.asarray(scene.forces.cable.pivot.wxyz)).as_matrix()
    assert (plug @ arrow)[:, 2] == pytest.approx(pull / size, abs=1e-6)
    scene.show(replace(EVERYTHING, measured=None))
    assert not scene.forces.cable.pivot.visible
