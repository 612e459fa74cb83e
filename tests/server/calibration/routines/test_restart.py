"""A routine that PlugPilot did not live to end."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.calibration.routines import robot_routine, stand
from server.calibration.routines.errors import NoQuestionError, NoRoutineError
from server.schema.routines import (
    BeltsRoutineRequest,
    PlayRoutineRequest,
    RobotRoutineRequest,
    RoutineAnswer,
)
from tests.support.garage import Scene, on_scene, shift_car


class PowerFailedError(Exception):
    """The power fails: nothing is tidied up."""


@pytest.mark.parametrize("request_", [RobotRoutineRequest(), BeltsRoutineRequest()])
def test_after_a_restart_it_says_what_happened_and_nothing_has_changed(
    tmp_path: Path, request_: RobotRoutineRequest | BeltsRoutineRequest
) -> None:
    async def first(scene: Scene) -> None:
        services = scene.services
        await services.routines.begin(request_, "Anna")
        await scene.until(lambda: (r := services.routines.shown) is not None and r.done >= 1)
        raise PowerFailedError

    async def second(scene: Scene) -> None:
        services = scene.services
        routine = services.routines.shown
        assert routine is not None
        assert (routine.kind, routine.begun_by) == (request_.kind, "Anna")
        assert routine.state == "failed"
        assert routine.asks is None
        assert routine.problem is not None
        assert routine.problem.code == "calibration_lost"
        assert "given up" in routine.problem.detail
        assert routine.calibration_id is None
        assert services.supervisor.holder is None
        assert services.calibrations.robot_in_force is None
        assert not await services.calibrations.page(kind=None, before=None, limit=5)
        with pytest.raises(NoRoutineError):
            await services.routines.resume()
        with pytest.raises(NoRoutineError):
            services.routines.confirm(RoutineAnswer(code="belts_marked"))

    with pytest.raises(PowerFailedError):
        on_scene(first, seed=2, folder=tmp_path)
    on_scene(second, seed=2, folder=tmp_path, parked=False)


@pytest.mark.parametrize("moved", [False, True])
def test_looks_outlive_a_restart_unless_the_label_has_moved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, moved: bool
) -> None:
    monkeypatch.setattr(stand, "FRAMES", 1)
    monkeypatch.setattr(robot_routine, "POSES", 10)
    monkeypatch.setattr(robot_routine, "FEWEST_LOOKS", 8)

    async def first(scene: Scene) -> None:
        routines = scene.services.routines
        await routines.begin(RobotRoutineRequest(), "Anna")
        await scene.until(lambda: (r := routines.shown) is not None and r.done >= 6)
        raise PowerFailedError

    async def second(scene: Scene) -> None:
        routines = scene.services.routines
        routine = routines.shown
        assert routine is not None
        assert (routine.state, routine.begun_by) == ("interrupted", "Anna")
        assert routine.done >= 5
        assert len(routine.looks) == routine.done
        if moved:
            shift_car(scene.garage, x_mm=0.5)
        await routines.resume()
        await routines.wait()
        routine = routines.shown
        assert routine is not None
        assert routine.state == ("failed" if moved else "finished")
        assert (routine.calibration_id is None) is moved
        if moved:
            assert routine.problem is not None
            assert routine.problem.code == "calibration_label_moved"
        else:
            assert routine.done == 10, "the first one twice, and one less of those that were left"

    with pytest.raises(PowerFailedError):
        on_scene(first, seed=2, folder=tmp_path)
    on_scene(second, seed=2, folder=tmp_path, parked=False)


def test_what_has_ended_is_still_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stand, "FRAMES", 1)

    async def first(scene: Scene) -> None:
        await scene.services.routines.begin(PlayRoutineRequest(approaches=3), "Anna")
        await scene.services.routines.wait()

    async def second(scene: Scene) -> None:
        routine = scene.services.routines.shown
        assert routine is not None
        assert routine.state == "finished"
        assert routine.verdict is not None
        assert [figure.code for figure in routine.figures][:2] == ["play_left_mm", "play_right_mm"]
        assert routine.calibration_id is not None
        assert not (await scene.services.calibrations.get(routine.calibration_id)).in_force

    on_scene(first, seed=2, folder=tmp_path)
    on_scene(second, seed=2, folder=tmp_path, parked=False)


def test_an_answer_to_an_older_question_is_refused() -> None:
    async def scenario(scene: Scene) -> None:
        routines = scene.services.routines
        await routines.begin(BeltsRoutineRequest(), "Anna")
        await scene.until(lambda: (r := routines.shown) is not None and r.asks is not None)
        with pytest.raises(NoQuestionError):
            routines.confirm(RoutineAnswer(code="belts_left", value=300.0))
        routines.confirm(RoutineAnswer(code="belts_marked"))
        with pytest.raises(NoQuestionError):
            routines.confirm(RoutineAnswer(code="belts_marked"))
        await routines.cancel()
        assert scene.services.supervisor.holder is None

    on_scene(scenario, seed=2)
