"""Switches, play, belts and force as guided routines, on the simulator."""

from __future__ import annotations

from typing import Any

import httpx
import numpy as np
import pytest

from drivers.simulator.parameters import SimulationParameters
from server.calibration.grade import Grade
from server.calibration.routines import stand
from server.config.settings import Settings
from server.control.model import PlugState
from server.schema.calibrations import (
    CalibrationDetail,
    ForceValues,
    PlayValues,
    RobotValues,
    SwitchesValues,
)
from server.schema.routines import Routine, RoutineAnswer
from tests.support.api import on_api, problem
from tests.support.garage import Scene

PLAY_MM = (0.05, 0.22)
SPRING_N_MM = 5.0


@pytest.fixture(autouse=True)
def _one_picture_of_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """Enough for these figures, and three times as fast."""
    monkeypatch.setattr(stand, "FRAMES", 1)


def with_parameters(**changes: dict[str, Any]) -> Settings:
    """The usual settings with other numbers of the simulator, by group."""
    settings = Settings()
    parameters = settings.simulation.parameters.model_dump()
    for group, numbers in changes.items():
        parameters[group] |= numbers
    simulation = settings.simulation.model_copy(
        update={"parameters": SimulationParameters.model_validate(parameters)}
    )
    return settings.model_copy(update={"simulation": simulation})


async def begun(client: httpx.AsyncClient, **request: object) -> None:
    answer = await client.post("calibrations/routine", json=request)
    assert answer.status_code == 202, answer.text


def shown(scene: Scene) -> Routine:
    routine = scene.services.routines.shown
    assert routine is not None
    return routine


async def asked(scene: Scene) -> str:
    """Wait for the next question, and return its code."""
    await scene.until(lambda: shown(scene).asks is not None or shown(scene).state != "running")
    asks = shown(scene).asks
    assert asks is not None, shown(scene)
    return asks.code


async def found(scene: Scene) -> CalibrationDetail:
    await scene.services.routines.wait()
    routine = shown(scene)
    assert routine.problem is None
    assert routine.state == "finished"
    assert routine.calibration_id is not None
    assert routine.figures
    kept = await scene.services.calibrations.get(routine.calibration_id)
    assert routine.verdict is kept.grade
    assert not kept.in_force
    return kept


def test_play_of_each_carriage_is_found_by_reversals() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client, kind="play", approaches=3)
        kept = await found(scene)
        values = kept.values
        assert isinstance(values, PlayValues)
        for play_mm, sigma_mm, truth_mm in (
            (values.left_mm, values.left_sigma_mm, PLAY_MM[0]),
            (values.right_mm, values.right_sigma_mm, PLAY_MM[1]),
        ):
            assert sigma_mm < 0.03
            assert play_mm == pytest.approx(truth_mm, abs=4 * sigma_mm + 0.02)
        assert kept.grade is Grade.USABLE
        assert "right carriage" in kept.remarks[0]
        assert values.left_following_mm < 0.05
        assert kept.error is not None
        assert kept.error_in_use is not None
        assert kept.error < kept.error_in_use

        activated = await client.post(f"calibrations/{kept.id}/activation", json={})
        assert activated.json()["in_force"]
        now = (await client.get("calibrations/now")).json()
        assert now["in_force"]["play"]["id"] == kept.id
        undone = await client.post("calibrations/roll-back", json={"kind": "play"})
        assert undone.json()["in_force"]["play"] is None

    settings = with_parameters(drives={"backlash_mm": (*PLAY_MM, 0.05)})
    on_api(scenario, seed=2, parked=True, settings=settings)


@pytest.mark.parametrize(("spread_mm", "grade"), [(0.01, Grade.GOOD), (0.15, Grade.USABLE)])
def test_the_spread_of_the_switches_is_found_by_homing(spread_mm: float, grade: Grade) -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client, kind="switches", approaches=4)
        kept = await found(scene)
        values = kept.values
        assert isinstance(values, SwitchesValues)
        spreads = np.array([values.left_spread_mm, values.right_spread_mm])
        # four of a spread are known to two fifths of it
        assert np.all(spreads < 2.0 * spread_mm + 0.02)
        assert spreads.max() > 0.4 * spread_mm - 0.01
        assert kept.grade is grade

    settings = with_parameters(homing={"repeatability_std_mm": spread_mm})
    on_api(scenario, seed=3, parked=True, settings=settings)


def test_belts_are_measured_with_a_rule_that_a_person_reads() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        mechanism = scene.garage.world.plant.mechanism
        await begun(client, kind="belts")
        problem(
            await client.post("calibrations/routine/confirm", json={"code": "belts_left"}),
            409,
            "calibration_no_question",
        )
        assert await asked(scene) == "belts_marked"
        before = scene.garage.world.advance(scene.now_s).carriages
        assert await scene.still(), "nothing moves while a person is at the rail"
        await client.post("calibrations/routine/confirm", json={"code": "belts_marked"})
        for name, axis, scale in (
            ("left", 0, mechanism.left_scale),
            ("right", 1, mechanism.right_scale),
        ):
            code = f"belts_{name}"
            assert await asked(scene) == code
            after = scene.garage.world.advance(scene.now_s).carriages
            gone_mm = abs(after[axis] - before[axis]) * scale
            wrong = {"code": code, "value": 30.0}
            problem(
                await client.post("calibrations/routine/confirm", json=wrong),
                422,
                "calibration_answer",
            )
            right = {"code": code, "value": round(gone_mm, 1)}
            await client.post("calibrations/routine/confirm", json=right)
        kept = await found(scene)
        values = kept.values
        assert isinstance(values, RobotValues)
        assert values.mechanism.left_scale == pytest.approx(mechanism.left_scale, abs=6e-4)
        assert values.mechanism.right_scale == pytest.approx(mechanism.right_scale, abs=6e-4)
        assert kept.error_in_use is not None
        assert kept.error is not None
        assert kept.error < kept.error_in_use

    settings = with_parameters(build={"belt_scale_std": 0.004})
    on_api(scenario, seed=2, parked=True, settings=settings)


async def confirmed(scene: Scene, code: str) -> None:
    assert await asked(scene) == code
    scene.services.routines.confirm(RoutineAnswer(code=code))


def test_friction_and_force_scale_from_strokes_and_a_spring() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client, kind="force", spring_n_mm=SPRING_N_MM, stroke_mm=10)
        await confirmed(scene, "force_clear")
        # The panel beside the socket is as soft as the spring in this garage.
        await confirmed(scene, "force_spring")
        kept = await found(scene)
        values = kept.values
        assert isinstance(values, ForceValues)
        drives = scene.garage.world.parameters.drives
        assert values.friction_n == pytest.approx(drives.friction_n, abs=0.4)
        assert values.offset_n == pytest.approx(0.0, abs=0.4)
        scale = scene.garage.world._force_scale  # the truth of this garage
        assert values.scale == pytest.approx(scale, abs=0.03)
        assert values.scale_sigma is not None
        assert values.scale_sigma < 0.04
        assert abs(scale - 1.0) > 0.05
        assert kept.grade is not Grade.GOOD
        assert "times the true one" in kept.remarks[-1]
        assert scene.services.supervisor.plug.state in {PlugState.FREE, PlugState.PARKED}

        await client.post(f"calibrations/{kept.id}/activation", json={})
        assert scene.services.supervisor.built.force_scale == values.scale
        await begun(client, kind="force", spring_n_mm=SPRING_N_MM, stroke_mm=10, strokes=2)
        await confirmed(scene, "force_clear")
        await confirmed(scene, "force_spring")
        again = (await found(scene)).values
        assert isinstance(again, ForceValues)
        assert again.scale == pytest.approx(scale, abs=0.03), "it measures what the board shows"

    settings = with_parameters(
        contact={"jam_stiffness_n_mm": SPRING_N_MM}, drives={"force_scale_std": 0.25}
    )
    on_api(scenario, seed=2, parked=True, settings=settings)


def test_a_stroke_that_meets_something_ends_gently() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client, kind="force", stroke_mm=60)
        await confirmed(scene, "force_clear")
        await scene.services.routines.wait()
        routine = shown(scene)
        assert routine.state == "interrupted"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_slide_hit"
        assert scene.garage.world.advance(scene.now_s).max_force_n < 60
        rho3_mm = scene.services.supervisor.telemetry.require().measured.position.rho3_mm
        assert rho3_mm == pytest.approx(scene.services.settings.geometry.rho3.min_mm, abs=0.1)

    on_api(scenario, seed=2, parked=True)


def test_all_routines_are_described() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        items = (await client.get("calibrations/routines")).json()["routines"]
        assert [item["kind"] for item in items][:3] == ["camera", "switches", "play"]
        assert len(items) == 8
        for item in items:
            request = {s["name"]: s["usual"] for s in item["settings"] if s["usual"] is not None}
            answer = await client.post(
                "calibrations/routine", json={"kind": item["kind"], **request}
            )
            assert answer.status_code in {202, 409}, answer.text
            await client.post("calibrations/routine/cancel")

    on_api(scenario, seed=2)
