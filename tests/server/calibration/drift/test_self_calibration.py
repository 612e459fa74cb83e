"""Self-calibration beside real jobs on the simulator."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import httpx
import numpy as np
import pytest

from drivers.simulator.plant import Plant
from server.calibration.drift import service
from server.calibration.drift.belts import BeltMemory, LookPair, seen_shift
from server.calibration.drift.memory import DriftMemory
from server.control.seat import HOLD_S
from server.jobs.model import JobState, JobType
from server.schema.calibrations import CalibrationKind
from server.simulated_calibration import tip_errors_mm
from tests.server.calibration.drift.test_belts import PARKED, job, stretched
from tests.server.calibration.robot.built import DRAWN, R_DRAWN, Workshop
from tests.support.api import on_api
from tests.support.garage import Scene, on_scene
from twin.as_built import PlanarAsBuilt


def as_drawn(seed: int) -> Workshop:
    """A robot that is built as drawn."""
    built = PlanarAsBuilt.as_drawn(DRAWN)
    return replace(Workshop.robot(seed), built=built, R_base_camera=R_DRAWN, label_ratio=1.0)


def stretch_left_belt(scene: Scene, by: float) -> None:
    """From now on the simulated left belt goes further."""
    plant: Plant = scene.garage.world.plant
    scale = plant.mechanism.left_scale * (1 + by)
    plant.mechanism = plant.mechanism.model_copy(update={"left_scale": scale})
    plant._sagged.cache_clear()


async def charge_once(scene: Scene) -> None:
    for type_ in (JobType.PLUG_IN, JobType.UNPLUG):
        done = await scene.carried_out(type_)
        assert done.state is JobState.SUCCEEDED, done.error
    await scene.services.self_calibration.settled()


async def learnt(scene: Scene, memory: BeltMemory) -> None:
    """As if the jobs of the last weeks had taught that."""
    drift, supervisor = scene.services.self_calibration, scene.services.supervisor
    async with supervisor.control("job", "Parking after the last of them") as lease:
        await supervisor.move_from_below(lease, supervisor.telemetry.require().commanded.position)
    await drift.settled()
    await drift._remember(DriftMemory(belts=memory))


def after_jobs(count: int, stretch: float) -> BeltMemory:
    robot, memory = as_drawn(1), BeltMemory()
    measured = PlanarAsBuilt.as_drawn(DRAWN)
    for number in range(1, count + 1):
        now = stretched(robot, stretch * number / count)
        pair = replace(job(now, measured), vehicle_id="demo")
        memory = memory.learn(seen_shift(measured, R_DRAWN, pair))
    return memory


def test_a_job_teaches_and_a_correction_is_a_version_that_can_be_rolled_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(service, "MOST_AT_ONCE", 5e-3)

    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        services = scene.services
        stretch_left_belt(scene, 0.002)
        before = tip_errors_mm(scene.garage.world, DRAWN, services.supervisor.built)
        await learnt(scene, after_jobs(99, 0.002))
        assert (await scene.carried_out(JobType.PLUG_IN)).state is JobState.SUCCEEDED
        await services.self_calibration.settled()
        assert services.calibrations.robot_in_force is None, "the plug is in the socket"
        assert (await scene.carried_out(JobType.UNPLUG)).state is JobState.SUCCEEDED
        await services.self_calibration.settled()
        assert len(await services.calibrations.page(kind=None, before=None, limit=5)) == 1
        drift = services.self_calibration.report
        assert drift.belts.jobs == 100
        assert drift.belts.refused_in_a_row == 0
        assert drift.belts.left_percent == pytest.approx(0.2, abs=0.06)
        assert drift.belts.exceeds
        assert [hint.code for hint in drift.hints] == ["belts_drifted"]
        (felt,) = drift.insertions
        assert (felt.vehicle_id, felt.learnt_from) == ("demo", 1)
        now = (await client.get("calibrations/now")).json()
        version = now["in_force"]["robot"]
        assert version["made_by"] == "PlugPilot"
        assert "jobs" in version["source"]
        assert version["error"] < version["error_in_use"]
        detail = (await client.get(f"calibrations/{version['id']}")).json()
        assert detail["evidence"]["provenance"] == "drift"
        assert now["drift"]["exceeds"]
        assert now["hints"][0]["code"] == "belts_drifted"
        after = tip_errors_mm(scene.garage.world, DRAWN, services.supervisor.built)
        assert np.percentile(after, 95) < 0.7 * np.percentile(before, 95)

        await client.post("calibrations/roll-back", json={"kind": "robot"})
        await scene.later(HOLD_S)
        await charge_once(scene)
        assert services.calibrations.robot_in_force is None, "a person has taken it back"
        assert services.self_calibration.report.belts.jobs <= 1

    on_api(scenario, seed=2, parked=True)


def test_what_was_learnt_outlives_a_restart(tmp_path: Path) -> None:
    async def first(scene: Scene) -> None:
        await learnt(scene, after_jobs(30, 0.0))
        await charge_once(scene)

    async def second(scene: Scene) -> None:
        report = scene.services.self_calibration.report
        assert report.belts.jobs == 31
        assert report.insertions[0].learnt_from == 1
        assert not await scene.services.calibrations.page(
            kind=CalibrationKind.ROBOT, before=None, limit=5
        )

    on_scene(first, seed=2, folder=tmp_path)
    on_scene(second, seed=2, folder=tmp_path, parked=False)


def test_pairs_of_looks_are_from_places_far_apart() -> None:
    measured = PlanarAsBuilt.as_drawn(DRAWN)
    pair: LookPair = job(as_drawn(1), measured)
    assert np.linalg.norm(pair.first.label_mm - pair.last.label_mm) > 40
    assert np.isfinite(measured.inverse_many(PARKED)).all()


def test_a_label_that_is_knocked_off_by_5_mm_teaches_nothing() -> None:
    async def scenario(scene: Scene) -> None:
        services, world = scene.services, scene.garage.world
        known = after_jobs(30, 0.0)
        await learnt(scene, known)
        label = world.car.T_base_label.copy()
        label[0, 3] += 5.0
        world.put_car(replace(world.car, T_base_label=label))
        job_ = await scene.carried_out(JobType.PLUG_IN)
        assert job_.state is JobState.FAILED
        assert job_.error is not None
        await services.self_calibration.settled()
        report = services.self_calibration.report
        assert services.self_calibration._memory.belts == known
        assert report.insertions == []
        assert services.calibrations.in_force.sockets == ()
        assert services.calibrations.robot_in_force is None

    on_scene(scenario, seed=2)
