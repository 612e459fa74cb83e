"""Plugs that meet an obstacle, nothing at all, or a lock."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from drivers.simulator.parameters import SimulationParameters
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.control.model import PlugState
from server.jobs.model import JobPhase, JobState, JobType
from server.localisation.socket_pose import SocketPose
from server.schema.jobs import Job
from server.schema.vehicles import Vehicle
from tests.support.garage import Scene, on_scene
from tests.support.knowing_eye import KnowingEye, let_it_know


def contact(**changes: Any) -> Settings:  # noqa: ANN401 - numbers of the contact
    numbers = SimulationParameters()
    changed = numbers.contact.model_copy(update=changes)
    numbers = numbers.model_copy(update={"contact": changed})
    return Settings(simulation=SimulationSettings(parameters=numbers))


def mislead(scene: Scene, *, right_mm: float = 0.0, deep_mm: float = 0.0) -> None:
    """The eye sees the socket beside where it is, as with a label that was stuck on anew."""
    let_it_know(scene.services)
    eye = scene.services.runner._eye
    assert isinstance(eye, KnowingEye)
    geometry = scene.services.supervisor.geometry
    eye.error_mm = np.array([right_mm, 0.0, 0.0]) + deep_mm * np.array(geometry.insertion_axis)


async def tries(scene: Scene, job: Job) -> list[dict[str, Any]]:
    return [event.data for event in await scene.events(job) if event.kind == "insertion_try"]


def code(job: Job) -> str | None:
    return job.error.code if job.error else None


@pytest.mark.parametrize("right_mm", [2.1, -2.1])
def test_a_socket_beside_the_measured_place_is_found_with_little_force(right_mm: float) -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene, right_mm=right_mm)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) is None
        made = await tries(scene, job)
        assert len(made) in {2, 3}, "the centre, the centre again, then one side or the other"
        assert all(one["depth_mm"] < 1.5 for one in made)
        assert all(one["max_force_n"] < 48.0 for one in made)
        assert all(one["force_n_over_depth_mm"] for one in made)
        assert [one["number"] for one in made] == list(range(1, len(made) + 1))
        truth = scene.truth()
        assert truth.seated
        assert truth.lateral_violation_mm == 0
        assert truth.lateral_error_mm < 1.5

    on_scene(scenario, seed=4)


def test_a_covered_socket_is_given_up_after_all_tries_and_the_robot_parks() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene, right_mm=12.0)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) == "insertion_jammed"
        assert job.error is not None
        assert job.error.context["tries"] == 6
        assert "Tried 6 times" in job.error.detail
        assert len(await tries(scene, job)) == 6
        assert scene.truth().max_contact_force_n < 50.0
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        station = await scene.station()
        assert not station.held, "the way back ends the hold"

    on_scene(scenario, seed=4)


def test_a_plug_that_meets_nothing_is_not_plugged_in() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) == "plug_missed"
        assert job.error is not None
        assert 30.0 < job.error.context["depth_mm"] < 37.0
        assert len(await tries(scene, job)) == 1, "there is nothing to search for"
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert not scene.services.supervisor.telemetry.require().fault

    on_scene(scenario, seed=4, settings=contact(peak_force_n=3.0, peak_force_std_n=0.0))


def test_an_end_stop_before_the_full_depth_is_the_seat() -> None:
    """The face was measured 0.8 mm too far away, and the socket ends at 40 mm."""

    async def scenario(scene: Scene) -> None:
        mislead(scene, deep_mm=0.8)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) is None, job.error
        assert job.result.insertion_depth_mm == pytest.approx(39.2, abs=0.3)
        assert not await tries(scene, job)
        (seated,) = [e for e in await scene.events(job) if e.kind == "seated"]
        assert "end stop" in seated.message
        assert scene.truth().seated
        assert scene.services.supervisor.fault is None
        assert (await scene.carried_out(JobType.UNPLUG)).error is None

    on_scene(scenario, seed=4, settings=contact(stop_depth_mm=39.9, seated_depth_mm=39.5))


def test_a_tight_socket_is_tried_once_more_and_not_searched() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) == "insertion_jammed"
        made = await tries(scene, job)
        assert [(one["right_mm"], one["up_mm"]) for one in made] == [(0.0, 0.0)] * 2
        assert all(one["depth_mm"] > 20.0 for one in made)
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert scene.truth().max_contact_force_n < 79.0 * 1.03

    on_scene(scenario, seed=4, settings=contact(peak_force_n=120.0))


def test_power_that_comes_while_the_plug_goes_in_makes_it_wait() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        station = scene.garage.station
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.until(lambda: scene.truth().insertion_depth_mm > 20.0)
        station.lie(currents_a=(10.0, 0.0, 0.0))
        await scene.later(0.4)
        at_mm = scene.truth().insertion_depth_mm
        await scene.later(2.0)
        assert scene.truth().insertion_depth_mm == pytest.approx(at_mm, abs=0.01)
        station.behave()
        ended = await scene.ended(job)
        assert ended.error is None
        kinds = await scene.kinds(job)
        assert kinds.count("insertion_waits") == 1
        assert "insertion_try" not in kinds, "it went on from where it stood"
        assert scene.truth().seated

    on_scene(scenario, seed=4)


def test_the_station_is_held_while_the_plug_goes_in_and_given_back_when_it_is() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.until_moving()
        assert (await scene.station()).held
        assert (await scene.ended(job)).error is None
        assert not (await scene.station()).held

    on_scene(scenario, seed=4)


def test_a_lock_says_how_far_the_plug_came() -> None:
    async def scenario(scene: Scene) -> None:
        world, supervisor = scene.garage.world, scene.services.supervisor
        mislead(scene)
        await scene.carried_out(JobType.PLUG_IN)
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        world.lock_connector(locked=True, now_s=scene.now_s)
        ended = await scene.ended(job)
        assert code(ended) == "connector_locked"
        assert ended.error is not None
        assert 0.0 <= ended.error.context["moved_mm"] < 2.0
        assert "still locked" in ended.error.detail
        assert supervisor.plug.state is PlugState.INSERTED
        world.lock_connector(locked=False, now_s=scene.now_s)
        if supervisor.fault is not None:
            await supervisor.reset()
        assert (await scene.carried_out(JobType.UNPLUG)).state is JobState.SUCCEEDED

    on_scene(scenario, seed=4)


def test_a_slide_that_lost_its_position_with_the_plug_in_comes_out_along_the_axis() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor, board = scene.services.supervisor, scene.garage.robot._board
        mislead(scene)
        await scene.carried_out(JobType.PLUG_IN)
        board.homed = False
        await scene.until(lambda: supervisor.plug.state is PlugState.UNKNOWN)
        job = await scene.carried_out(JobType.UNPLUG)
        assert job.error is None
        assert supervisor.plug.state is PlugState.PARKED
        assert scene.truth().lateral_violation_mm == 0

    on_scene(scenario, seed=4)


def test_a_car_that_is_gone_while_it_charges_leaves_the_plug_to_a_person() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        point = scene.garage.station.point
        point._connection_changed(False, scene.now_s)
        ended = await scene.ended(job)
        assert code(ended) == "car_gone"
        assert scene.services.supervisor.plug.state is PlugState.UNKNOWN
        assert await scene.still()
        assert not (await scene.station()).enabled

    on_scene(scenario, seed=4)


def test_a_station_that_repeats_itself_while_the_car_charges_is_silent() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        began_s = scene.now_s
        scene.garage.station.freeze()
        await scene.until(lambda: scene.seen[-1] is not JobPhase.CHARGING)
        assert 60.0 < scene.now_s - began_s < 63.0
        scene.garage.station.behave()
        ended = await scene.ended(job)
        assert code(ended) == "station_unsafe"

    on_scene(scenario, seed=4)


def test_a_stale_picture_is_no_place_to_push_to() -> None:
    async def scenario(scene: Scene) -> None:
        mislead(scene)
        runner = scene.services.runner
        eye = runner._eye
        assert isinstance(eye, KnowingEye)
        measure = eye.measure

        async def measure_slowly(
            vehicle: Vehicle, frames: int, expected: SocketPose | None
        ) -> SocketPose | None:
            socket = await measure(vehicle, frames, expected)
            assert socket is not None
            if scene.seen[-1] is JobPhase.ALIGNING:
                return replace(socket, measured_at_s=socket.measured_at_s - 10.0)
            return socket

        eye.measure = measure_slowly  # type: ignore[method-assign]
        job = await scene.carried_out(JobType.PLUG_IN)
        assert code(job) is None
        kinds = await scene.kinds(job)
        assert kinds.count("measured_again") == 1
        assert kinds.index("measured_again") < kinds.index("seated")

    on_scene(scenario, seed=4)
