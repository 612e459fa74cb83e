"""Every failure has its own code, and leaves plug and robot as safe as it can."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from drivers.simulator.camera.imaging import CameraFault
from server.control.errors import (
    ControlBusyError,
    EmergencyStoppedError,
    RobotFaultError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.model import PlugState
from server.jobs.errors import PlugStateError
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.problem import TYPE_PREFIX
from tests.support.garage import Scene, on_scene, shift_car


async def _assert_fails(scene: Scene, code: str, job_type: JobType = JobType.PLUG_IN) -> None:
    job = await scene.carried_out(job_type)
    assert job.state is JobState.FAILED
    assert job.error is not None
    assert job.error.code == code
    assert job.error.type == TYPE_PREFIX + code
    assert job.error.detail
    assert job.error.remedy
    assert scene.services.supervisor.holder is None
    truth = scene.truth()
    assert truth.load_breaks == 0
    assert truth.lateral_violation_mm == 0


def _cover_label(scene: Scene) -> None:
    scene.garage.world.hide_label()


def _drive_away(scene: Scene) -> None:
    scene.garage.world.remove_car()


def _park_too_low(scene: Scene) -> None:
    shift_car(scene.garage, z_mm=80.0)


def _park_skewed(scene: Scene) -> None:
    shift_car(scene.garage, yaw_rad=math.radians(8.0))


def _unplug_camera(scene: Scene) -> None:
    scene.garage.camera.fault = CameraFault.UNPLUGGED


def _stall_camera(scene: Scene) -> None:
    scene.garage.camera.fault = CameraFault.STALLED


def _darken_camera(scene: Scene) -> None:
    scene.garage.camera.fault = CameraFault.DARK


@pytest.mark.parametrize(
    ("trouble", "code"),
    [
        (_cover_label, "label_not_found"),
        (_drive_away, "label_not_found"),
        (_darken_camera, "label_not_found"),
        (_park_too_low, "socket_unreachable"),
        (_park_skewed, "socket_too_skewed"),
        (_unplug_camera, "camera_down"),
        (_stall_camera, "camera_down"),
    ],
)
def test_what_the_eye_cannot_do(trouble: Callable[[Scene], None], code: str) -> None:
    async def scenario(scene: Scene) -> None:
        trouble(scene)
        await _assert_fails(scene, code)
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert JobPhase.INSERTING not in scene.seen

    on_scene(scenario, seed=4)


@pytest.mark.parametrize("fault", [CameraFault.UNPLUGGED, CameraFault.STALLED])
def test_a_camera_that_fails_on_the_way_brings_the_robot_back(fault: CameraFault) -> None:
    async def scenario(scene: Scene) -> None:
        async def fail() -> None:
            await scene.until_phase(JobPhase.ALIGNING)
            await scene.until_moving()
            scene.garage.camera.fault = fault

        job = await scene.start(JobType.PLUG_IN)
        await fail()
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "camera_down"
        assert scene.seen[-1] is JobPhase.PARKING
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=4)


def test_a_label_that_disappears_on_the_way_brings_the_robot_back() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        scene.garage.world.hide_label()
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "label_not_found"
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=4)


def test_a_robot_that_loses_its_link_stops_and_unplugs_later() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.later(3.0)
        scene.garage.robot.unplug_link()
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "robot_offline"
        assert supervisor.plug.state is PlugState.INSERTED
        await scene.later(0.5)  # nobody can see it, but the board has noticed the silence by now
        assert await scene.still()
        with pytest.raises(RobotOfflineError):
            await scene.start(JobType.UNPLUG)
        scene.garage.robot.replug_link()
        await scene.until(lambda: supervisor.telemetry.latest is not None)
        with pytest.raises(RobotFaultError):
            await scene.start(JobType.UNPLUG)
        await supervisor.reset()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None
        assert scene.truth().lateral_violation_mm == 0

    on_scene(scenario, seed=4)


def test_a_fault_of_the_drives_is_no_locked_connector() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        await scene.until_moving()
        scene.garage.robot.trip_limit(0)
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "robot_fault"
        assert ended.error.context["fault"] == "limit_switch"
        assert await scene.still()
        # the way out is known, but no longer where the robot is: back along the axis it goes
        assert not scene.services.supervisor.telemetry.require().homed
        scene.garage.robot.mend_limit(0)
        await scene.services.supervisor.reset()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None
        assert scene.truth().lateral_violation_mm == 0

    on_scene(scenario, seed=4)


def test_a_locked_connector_is_not_torn_out() -> None:
    async def scenario(scene: Scene) -> None:
        world, supervisor = scene.garage.world, scene.services.supervisor
        await scene.carried_out(JobType.PLUG_IN)
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        world.lock_connector(locked=True, now_s=scene.now_s)
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "connector_locked"
        assert ended.error.context["max_pull_n"] <= 85.0
        assert supervisor.plug.state is PlugState.INSERTED
        assert scene.truth().insertion_depth_mm > 38.0
        assert scene.truth().max_contact_force_n < 90.0
        world.lock_connector(locked=False, now_s=scene.now_s)
        if supervisor.fault is not None:
            await supervisor.reset()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None

    on_scene(scenario, seed=4)


def test_jobs_are_refused_before_anything_is_kept_of_them() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor, robot = scene.services.supervisor, scene.garage.robot
        with pytest.raises(PlugStateError):
            await scene.start(JobType.UNPLUG)
        await supervisor.stop()
        with pytest.raises(RobotStoppedError):
            await scene.start(JobType.PLUG_IN)
        await supervisor.emergency_stop()
        with pytest.raises(EmergencyStoppedError):
            await scene.start(JobType.PLUG_IN)
        await scene.later(0.5)
        await supervisor.reset()
        async with supervisor.control("jog", "A technician"):
            with pytest.raises(ControlBusyError, match="A technician"):
                await scene.start(JobType.PLUG_IN)
        robot.unplug_link()
        await scene.later(1.0)
        with pytest.raises(RobotOfflineError):
            await scene.start(JobType.PLUG_IN)
        robot.replug_link()
        await scene.until(lambda: supervisor.telemetry.latest is not None)
        await supervisor.reset()
        assert await scene.services.jobs.page(before=None, limit=10) == []

    on_scene(scenario, seed=4)
