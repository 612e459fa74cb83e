"""A garage around a robot that is not its own: here another simulated one, and a fake board."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.camera import pi_camera_v2
from drivers.registry import ARDUINO, SIMULATOR, DeviceRequest, make_devices
from drivers.robot import BoardState, RobotDriver, RobotState
from drivers.simulator.following import RobotFollower
from drivers.simulator.garage import FollowedGarage, build_followed_garage, build_garage
from drivers.simulator.parameters import SimulationParameters
from drivers.station import PilotState
from tests.drivers.simulator.stand import GEOMETRY, HOMED, LIMITS, PERFECT, Stand, changed, run
from tests.support.board_cable import board_cable
from tests.support.eventually import eventually
from twin.camera_mount import CameraMount
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma

SEED = 3
AWAY = JointPosition(190.0, 140.0, 70.0)


def followed_garage(parameters: SimulationParameters) -> FollowedGarage:
    return build_followed_garage(
        GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), parameters, seed=SEED
    )


@asynccontextmanager
async def following(follower: RobotFollower, robot: RobotDriver) -> AsyncIterator[None]:
    """Every sample of the robot goes to the follower."""

    async def pass_on() -> None:
        async for state in robot.telemetry():
            follower.take(state)

    task = asyncio.create_task(pass_on())
    try:
        yield
    finally:
        task.cancel()
        await asyncio.wait([task])


def beside(
    scenario: Callable[[Stand, FollowedGarage], Awaitable[None]], parameters: SimulationParameters
) -> None:
    """Run a scenario with an enabled robot that moves in one garage and is followed by another."""

    async def main() -> None:
        stand = Stand(
            build_garage(GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), parameters, seed=SEED)
        )
        around = followed_garage(parameters)
        await stand.robot.connect()
        await around.station.open()
        async with following(around.follower, stand.robot):
            await stand.robot.enable()
            await asyncio.sleep(0.2)
            await scenario(stand, around)
        await stand.robot.close()

    run(main())


@pytest.fixture(scope="module")
def template() -> RobotState:
    """Any sample of a board, to be filled in."""

    async def first() -> RobotState:
        robot = build_garage(
            GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), PERFECT, seed=SEED
        ).robot
        await robot.connect()
        state = await anext(robot.telemetry())
        await robot.close()
        return state

    return run(first())


def sample(
    template: RobotState, position: JointPosition, at_s: float, *, homed: bool
) -> RobotState:
    """What a board says that stands somewhere."""
    measured = replace(template.measured, position=position)
    return replace(template, sampled_at_s=at_s, measured=measured, homed=homed)


def plug_mm(around: FollowedGarage) -> NDArray[np.float64]:
    """The true place of the plug's tip."""
    return around.world.truth().T_base_plug[:3, 3]


def test_the_plug_goes_into_the_other_garages_socket_and_out_again() -> None:
    async def scenario(stand: Stand, around: FollowedGarage) -> None:
        joints = await stand.align()
        assert (await around.station.snapshot()).pilot is PilotState.A
        await stand.insert(joints)
        there, here = stand.world.truth(stand.now_s), around.world.truth()
        assert here.seated
        assert here.lateral_error_mm == pytest.approx(there.lateral_error_mm, abs=0.02)
        assert here.insertion_depth_mm == pytest.approx(there.insertion_depth_mm, abs=0.1)
        assert here.max_contact_force_n == pytest.approx(there.max_contact_force_n, abs=5.0)
        assert (await around.station.snapshot()).pilot is PilotState.B
        await stand.move(joints)
        await stand.rest()
        assert (await around.station.snapshot()).pilot is PilotState.A
        assert around.world.truth().lateral_violation_mm < 0.01

    beside(scenario, HOMED)


def test_the_camera_sees_what_it_would_see_on_the_robot() -> None:
    async def scenario(stand: Stand, around: FollowedGarage) -> None:
        moving = asyncio.create_task(stand.move(AWAY))
        await asyncio.sleep(0.6)
        exposed_s = stand.now_s
        await asyncio.sleep(0.05)  # a picture takes this long to be delivered
        there, here = stand.world.view_at(exposed_s), around.world.view_at(exposed_s)
        assert np.linalg.norm(there.label_velocity_mm_s) > 20.0
        assert here.label_velocity_mm_s == pytest.approx(there.label_velocity_mm_s, abs=2.0)
        assert here.T_camera_label == pytest.approx(there.T_camera_label, abs=0.05)
        await moving
        await stand.rest()
        there, here = stand.world.view_at(stand.now_s), around.world.view_at(stand.now_s)
        assert here.T_camera_label == pytest.approx(there.T_camera_label, abs=0.02)

    beside(scenario, HOMED)


def test_homing_draws_the_plug_out_before_it_moves_sideways() -> None:
    async def scenario(stand: Stand, around: FollowedGarage) -> None:
        assert around.world.truth().insertion_depth_mm > 20.0, "where the board remembers to stand"
        assert around.world.pilot_made
        gone: list[float] = []
        around.world.on_connection(lambda made, at_s: gone.append(at_s) if not made else None)
        await stand.robot.home()
        await asyncio.sleep(0.3)
        assert gone, "the pilot contact opened"
        truth = around.world.truth()
        assert truth.lateral_violation_mm < 0.5
        expected = gamma.forward(GEOMETRY, around.world.homed_joints)
        assert truth.T_base_plug[:3, 3] == pytest.approx(np.array(expected), abs=0.1)

    garage = build_garage(GEOMETRY, LIMITS, CameraMount(), pi_camera_v2(), PERFECT, seed=SEED)
    socket = garage.world.car.T_base_socket
    deep = socket[:3, 3] + 39.5 * socket[:3, 2]
    inside = gamma.inverse(GEOMETRY, TipPosition(*deep))
    board = changed(PERFECT, "board", start_homed=False, start_joints=inside)
    beside(scenario, changed(board, "homing", power_off_creep_std_mm=2.0))


def test_without_homing_only_changes_count_and_a_new_number_moves_nothing(
    template: RobotState,
) -> None:
    around = followed_garage(PERFECT)
    take = around.follower.take
    here = JointPosition(150.0, 150.0, 60.0)
    take(sample(template, here, 10.0, homed=False))
    take(sample(template, here, 10.1, homed=False))
    first = plug_mm(around).copy()
    assert first == pytest.approx(np.array(gamma.forward(GEOMETRY, here)), abs=0.1)
    numbered = here._replace(rho3_mm=50.0)
    take(sample(template, numbered, 10.11, homed=False))
    take(sample(template, numbered, 10.21, homed=False))
    assert plug_mm(around) == pytest.approx(first, abs=1e-6)
    take(sample(template, numbered._replace(rho3_mm=51.0), 10.31, homed=False))
    assert np.linalg.norm(plug_mm(around) - first) == pytest.approx(1.0, abs=0.02)


def test_a_homed_robot_stands_where_it_says(template: RobotState) -> None:
    around = followed_garage(PERFECT)
    around.follower.take(sample(template, JointPosition(150.0, 150.0, 60.0), 10.0, homed=False))
    for tenth in range(1, 4):
        around.follower.take(sample(template, AWAY, 10.0 + 0.1 * tenth, homed=True))
    expected = np.array(gamma.forward(GEOMETRY, AWAY))
    assert plug_mm(around) == pytest.approx(expected, abs=0.1)


def test_an_old_sample_and_an_early_question_do_no_harm(template: RobotState) -> None:
    around = followed_garage(PERFECT)
    start = JointPosition(150.0, 150.0, 60.0)
    around.follower.take(sample(template, start, 10.0, homed=True))
    around.follower.take(sample(template, start._replace(rho3_mm=60.1), 10.01, homed=True))
    around.world.truth(10.04)  # somebody asks about a time that no sample has told of yet
    around.follower.take(sample(template, start, 10.005, homed=True))
    around.follower.take(sample(template, start._replace(rho3_mm=60.2), 10.02, homed=True))
    around.follower.take(sample(template, start._replace(rho3_mm=60.8), 10.08, homed=True))
    around.follower.take(sample(template, start._replace(rho3_mm=60.8), 10.18, homed=True))
    expected = np.array(gamma.forward(GEOMETRY, start._replace(rho3_mm=60.8)))
    assert plug_mm(around) == pytest.approx(expected, abs=0.06)


async def test_the_drivers_of_the_registry_follow_the_board(tmp_path: Path) -> None:
    with board_cable(tmp_path) as cable:
        devices = make_devices(
            DeviceRequest(
                robot=ARDUINO,
                camera=SIMULATOR,
                station=SIMULATOR,
                port=str(cable.device),
                geometry=GEOMETRY,
                limits=LIMITS,
                mount=CameraMount(),
                optics=pi_camera_v2(),
                simulation=PERFECT,
                seed=SEED,
            )
        )
        assert devices.garage is None
        around = devices.followed
        assert around is not None
        assert devices.world is around.world
        assert devices.camera is around.camera
        assert devices.station is around.station
        await devices.robot.connect()
        async with following(around.follower, devices.robot):
            await devices.robot.enable()
            await devices.robot.home()
            expected = np.array(gamma.forward(GEOMETRY, JointPosition(150.0, 150.0, 50.0)))
            await eventually(lambda: np.allclose(plug_mm(around), expected, atol=0.1))
            states = [state async for state in _some(devices.robot)]
            assert states[-1].board is BoardState.READY
        await devices.robot.close()


async def _some(robot: RobotDriver) -> AsyncIterator[RobotState]:
    async for state in robot.telemetry():
        yield state
        return
