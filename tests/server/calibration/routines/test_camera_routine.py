"""The camera is calibrated with the board in a simulated hand, which does what it is asked for."""

from __future__ import annotations

import asyncio
from typing import Any

import httpx
import pytest

from server.calibration.grade import Grade
from server.calibration.routines import camera_routine
from server.config.settings import Settings
from server.labels.board_layout import BoardLayout
from server.schema.board import BoardLook, BoardWish
from server.schema.calibrations import CameraValues
from server.schema.routines import Routine
from server.schema.simulation import HoldBoard
from server.simulated_hand import SimulatedHand
from tests.support.api import on_api, problem
from tests.support.garage import Scene

COLUMNS = {"left": -0.6, "right": 0.6}
ROWS = {"top": -0.55, "upper": -0.55, "bottom": 0.55, "lower": 0.55}
ATTITUDES: dict[str, dict[str, float]] = {
    "left_away": {"left_away_deg": 28}, "right_away": {"left_away_deg": -28},
    "top_away": {"top_away_deg": 28}, "bottom_away": {"top_away_deg": -28},
    "turned": {"turn_deg": 90}, "nearer": {"distance_mm": 300}, "farther": {"distance_mm": 460},
}  # fmt: skip
SMALL = 2
"""Pictures of half the width take a quarter of the time."""
PATIENCE = 12
"""Pictures after which a hand that did what it was asked for gives up."""


def settings() -> Settings:
    """A camera that is not as its data sheet says."""
    usual = Settings()
    optics = usual.camera.optics
    changes = {
        "width": optics.width // SMALL, "height": optics.height // SMALL,
        **{name: getattr(optics, name) / SMALL for name in ("fx", "fy", "cx", "cy")},
    }  # fmt: skip
    camera = usual.camera.model_copy(update={"optics": optics.model_copy(update=changes)})
    parameters = usual.simulation.parameters
    build = parameters.build.model_copy(
        update={"focal_std_fraction": 0.01, "principal_point_std_px": 4.0}
    )
    simulation = usual.simulation.model_copy(
        update={"parameters": parameters.model_copy(update={"build": build})}
    )
    return usual.model_copy(update={"camera": camera, "simulation": simulation})


def shown(scene: Scene) -> Routine:
    routine = scene.services.routines.shown
    assert routine is not None
    return routine


async def begun(client: httpx.AsyncClient) -> None:
    answer = await client.post("calibrations/routine", json={"kind": "camera"})
    assert answer.status_code == 202, answer.text


async def looked(client: httpx.AsyncClient, after: int) -> BoardLook | None:
    """The next picture; None: the routine looks no more."""
    answer = await client.get("calibrations/routine/board", params={"after": after})
    return None if answer.status_code == 409 else BoardLook.model_validate_json(answer.content)


async def hold(client: httpx.AsyncClient, wish: BoardWish) -> None:
    """Do what is asked for."""
    place = (wish.place or "middle").split("_")
    wanted: dict[str, Any] = {
        "right": sum(COLUMNS.get(part, 0.0) for part in place),
        "down": sum(ROWS.get(part, 0.0) for part in place),
        "within_s": 0.05,
    }
    wanted |= ATTITUDES[wish.attitude] if wish.attitude else {}
    answer = await client.post("simulation/board", json={"type": "hold", **wanted})
    assert answer.status_code == 200, answer.text


def test_a_hand_that_does_what_it_is_asked_for_gets_a_camera_that_can_be_used() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client)
        look = await looked(client, 0)
        assert look is not None
        assert look.notice == "no_board"
        pictures = 0
        while look is not None:
            taken, wish, tries = look.taken, look.wish, 0
            await hold(client, wish)
            while look is not None and look.taken == taken:
                look = await looked(client, look.sequence)
                pictures, tries = pictures + 1, tries + 1
                assert tries < PATIENCE, (look, wish)
            if taken == 0:
                assert look is not None
                assert len(look.corners_px) >= 12
                paper = await client.get(f"calibrations/routine/board/{look.sequence}.jpg")
                assert paper.headers["content-type"] == "image/jpeg"
        await scene.services.routines.wait()
        routine = shown(scene)
        assert routine.problem is None
        assert routine.calibration_id is not None
        kept = await scene.services.calibrations.get(routine.calibration_id)
        evidence = kept.camera_evidence
        assert evidence is not None
        assert routine.done == len(evidence.views) >= 15
        assert kept.grade is not Grade.BAD
        assert kept.error is not None
        assert kept.error_in_use is not None
        assert kept.error < kept.error_in_use
        values, truth = kept.values, scene.garage.camera.optics
        assert isinstance(values, CameraValues)
        for name in ("fx", "fy", "cx", "cy"):
            error = getattr(values.camera, name) - getattr(truth, name)
            assert abs(error) < 4 * evidence.sigma[name] < 4.0, name
        assert not kept.in_force

        activated = await client.post(f"calibrations/{kept.id}/activation", json={})
        assert activated.json()["in_force"]
        undone = await client.post("calibrations/roll-back", json={"kind": "camera"})
        assert undone.json()["in_force"]["camera"] is None

    on_api(scenario, seed=2, settings=settings())


def test_what_is_there_can_be_worked_out_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(camera_routine, "FEWEST_VIEWS", 6)

    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await begun(client)
        while (look := await looked(client, 0)) and shown(scene).asks is None:
            await hold(client, look.wish)
            await asyncio.sleep(0.5)
        asks = shown(scene).asks
        assert asks is not None
        assert shown(scene).state == "running"
        await client.post("calibrations/routine/confirm", json={"code": asks.code})
        await scene.services.routines.wait()
        assert shown(scene).verdict is not None
        assert shown(scene).verdict is not Grade.GOOD
        assert shown(scene).remarks

    on_api(scenario, seed=2, settings=settings())


@pytest.mark.parametrize(
    ("held", "layout", "code"),
    [
        (False, BoardLayout(), "calibration_no_board"),
        (True, BoardLayout(5, 7, 30, 22), "calibration_wrong_board"),
        (True, BoardLayout(), "calibration_too_few_views"),
    ],
)
def test_what_keeps_it_from_going_on_is_named(
    monkeypatch: pytest.MonkeyPatch, held: bool, layout: BoardLayout, code: str
) -> None:
    for name, patience_s in {"UNSEEN_S": 0.6, "OTHER_S": 0.4, "IDLE_S": 0.9}.items():
        monkeypatch.setattr(camera_routine, name, patience_s)

    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        hand = SimulatedHand(
            scene.garage.camera, scene.services.settings.simulation.parameters.imaging, layout
        )
        if held:
            hand.carry_out(HoldBoard(within_s=0))
        await begun(client)
        await scene.services.routines.wait()
        routine = shown(scene)
        assert routine.problem is not None
        assert (routine.problem.code, routine.state) == (code, "interrupted")
        problem(await client.get("calibrations/routine/board"), 409, "calibration_none")
        resumed = await client.post("calibrations/routine/resume")
        assert resumed.json()["state"] == "running"

    on_api(scenario, seed=2, settings=settings())
