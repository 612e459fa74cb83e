"""What the model sees of whole jobs, good and bad ones."""

from __future__ import annotations

import pytest

from drivers.simulator.parameters import SimulationParameters
from server.config.settings import Settings
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import JobEvent
from tests.support.garage import Scene, on_scene


def with_parameters(group: str, **numbers: object) -> Settings:
    """Settings whose simulated machine has other numbers than the model expects."""
    parameters = SimulationParameters()
    changed = getattr(parameters, group).model_copy(update=numbers)
    parameters = parameters.model_copy(update={group: changed})
    settings = Settings()
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    return settings.model_copy(update={"simulation": simulation})


async def found(scene: Scene, job_type: JobType = JobType.PLUG_IN) -> list[JobEvent]:
    """Run a job and return what the model has found."""
    job = await scene.carried_out(job_type, 5.0 if job_type is JobType.CHARGE else None)
    return [event for event in await scene.events(job) if event.kind == "divergence"]


def quantities(events: list[JobEvent]) -> set[object]:
    return {event.data["quantity"] for event in events}


def lose_steps(scene: Scene, distance_mm: float) -> None:
    """The left carriage slips on its belt: the step counter does not know."""
    world = scene.garage.world
    state = world.advance(scene.now_s)
    world._zero = world._zero._replace(rho1_mm=world._zero.rho1_mm - distance_mm)
    carriages = state.carriages._replace(rho1_mm=state.carriages.rho1_mm - distance_mm)
    world._disturb(state._replace(carriages=carriages))


@pytest.mark.parametrize("seed", [0, 10, 43])
def test_a_good_job_raises_nothing(seed: int) -> None:
    assert on_scene(lambda scene: found(scene, JobType.CHARGE), seed=seed) == []


def test_a_jammed_slide_is_seen_before_the_board_gives_up() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.until_moving()
        await scene.later(0.6)
        jammed_s = scene.now_s
        scene.garage.world.jam_slide(jammed_s)
        await scene.until(lambda: bool(scene.services.divergence.parted), step_s=0.002)
        # The watch over the plug ends the push within 60 ms, before the deviation has lasted long
        # enough to be one; the pull back shows it.
        assert scene.now_s - jammed_s < 0.5
        assert scene.services.supervisor.fault is None
        ended = await scene.ended(job)
        assert ended.state is JobState.FAILED
        events = [e for e in await scene.events(job) if e.kind == "divergence"]
        # The slide's encoder shows it too, but the board may stall before it has lasted.
        assert {"force"} <= quantities(events) <= {"force", "rho3"}
        assert events[0].phase is JobPhase.INSERTING
        assert events[0].data["sigmas"] > 20
        assert events[0].data["depth_mm"] < 0

    on_scene(scenario, seed=3)


@pytest.mark.parametrize("seed", [1, 3, 7])
def test_a_socket_with_a_third_more_friction_is_seen_before_the_force_limit(seed: int) -> None:
    async def scenario(scene: Scene) -> None:
        event = (await found(scene))[0]
        assert event.data["quantity"] == "force"
        assert event.phase is JobPhase.INSERTING
        assert 15 < event.data["depth_mm"] < 36
        assert event.data["measured"] < 75

    on_scene(scenario, seed=seed, settings=with_parameters("contact", peak_force_n=91.0))


def test_a_slow_slide_is_seen_although_the_job_succeeds() -> None:
    async def scenario(scene: Scene) -> None:
        events = await found(scene)
        newest = scene.services.runner.newest
        assert newest is not None
        assert newest.state is JobState.SUCCEEDED
        assert quantities(events) == {"rho3"}

    on_scene(scenario, seed=3, settings=with_parameters("drives", lag_s=0.06))


def test_steps_lost_between_two_pictures_are_seen_by_the_camera_alone() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.until_moving()
        lose_steps(scene, 2.0)
        ended = await scene.ended(job)
        events = [e for e in await scene.events(job) if e.kind == "divergence"]
        assert quantities(events) == {"socket"}
        assert events[0].phase is JobPhase.ALIGNING
        assert events[0].data["measured"] == pytest.approx(1.3, abs=0.4)
        # The last picture was taken after it, so the plug meets the socket all the same.
        assert ended.state is JobState.SUCCEEDED
        assert scene.truth().lateral_error_mm < 0.5

    on_scene(scenario, seed=3)


def test_steps_lost_before_the_first_picture_cannot_be_seen_and_do_no_harm() -> None:
    async def scenario(scene: Scene) -> None:
        lose_steps(scene, 1.0)
        assert await found(scene) == []
        assert scene.truth().lateral_error_mm < 0.6

    on_scene(scenario, seed=3)


def test_steps_lost_after_the_last_picture_cannot_be_seen() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        lose_steps(scene, 0.7)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED  # the chamfer takes it up
        assert [e for e in await scene.events(job) if e.kind == "divergence"] == []
        assert scene.truth().lateral_error_mm > 0.3

    on_scene(scenario, seed=3)


def test_everyone_who_watches_is_told_in_words() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.until_moving()
        await scene.later(0.6)
        scene.garage.world.jam_slide(scene.now_s)
        await scene.until(lambda: bool(services.divergence.parted))
        snapshot = await anext(services.live.watch())
        assert b'"title":"The force is not that of a good insertion"' in snapshot
        await scene.ended(job)
        scene.garage.world.free_slide(scene.now_s)

    on_scene(scenario, seed=3)
