"""Versions are kept for ever, put in force on purpose, and taken back in one step."""

from __future__ import annotations

from pathlib import Path

import httpx
import pytest

from server.calibration.grade import Grade
from server.calibration.versions.errors import CalibrationWorseError, NothingToRollBackError
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.values import rotation_matrix, rotation_vector
from server.control.errors import CalibrationHeldError, ControlBusyError
from server.control.model import PlugState
from server.jobs.model import JobType
from server.schema.calibrations import CalibrationKind, CameraValues, RobotEvidence, RobotValues
from server.storage.errors import StorageError
from tests.server.calibration.robot.built import DRAWN, Workshop
from tests.support.api import on_api, problem
from tests.support.garage import Scene, on_scene
from twin.as_built import PlanarAsBuilt

ROBOT = CalibrationKind.ROBOT


def values(left_leg_mm: float = 533.0) -> RobotValues:
    drawn = PlanarAsBuilt.as_drawn(DRAWN)
    return RobotValues(
        mechanism=drawn.model_copy(update={"left_leg_mm": left_leg_mm}),
        camera_rotation_rad=(0.01, -0.02, 3.1),
    )


def new(left_leg_mm: float = 533.0) -> NewCalibration:
    return NewCalibration(
        values(left_leg_mm), "Anna", "A test", Grade.GOOD, error=0.03, error_in_use=2.0
    )


def mechanism(scene: Scene) -> PlanarAsBuilt | None:
    correction = scene.services.supervisor.built.correction
    return correction.built if correction else None


def test_a_version_is_kept_with_where_it_comes_from_and_counts_only_when_activated(
    tmp_path: Path,
) -> None:
    async def first(scene: Scene) -> str:
        calibrations = scene.services.calibrations
        kept = await calibrations.keep(new())
        assert (kept.version, kept.made_by, kept.source) == (1, "Anna", "A test")
        assert not kept.in_force
        assert mechanism(scene) is None
        optics = scene.services.settings.camera.optics
        active = await calibrations.activate(kept.id, by="Ben", accept_worse=False)
        assert active.in_force
        assert mechanism(scene) == values().mechanism
        assert scene.services.supervisor.geometry == DRAWN
        eye = scene.services.runner._eye
        assert eye.mount.rotation_x_rad == 0.01
        assert eye.mount.x_mm == scene.services.settings.camera.mount.x_mm
        assert eye.optics == optics
        assert scene.services.guide._mount == eye.mount
        return kept.id

    async def after_a_restart(scene: Scene) -> None:
        assert mechanism(scene) == values().mechanism
        assert scene.services.runner._eye.mount.rotation_x_rad == 0.01
        assert scene.services.guide._mount.rotation_x_rad == 0.01
        (found,) = await scene.services.calibrations.page(kind=ROBOT, before=None, limit=5)
        assert found.id == kept_id
        assert found.in_force

    kept_id = on_scene(first, folder=tmp_path, parked=False)
    on_scene(after_a_restart, folder=tmp_path, parked=False)


def test_rolling_back_walks_back_to_the_configuration() -> None:
    async def scenario(scene: Scene) -> None:
        calibrations = scene.services.calibrations
        ids = []
        for leg_mm in (533.0, 534.0):
            kept = await calibrations.keep(new(leg_mm))
            await calibrations.activate(kept.id, by="Anna", accept_worse=False)
            ids.append(kept.id)
        await calibrations.activate(ids[1], by="Anna", accept_worse=False)  # changes nothing
        back = await calibrations.roll_back(ROBOT, by="Ben")
        assert back is not None
        assert back.id == ids[0]
        assert mechanism(scene) == values(533.0).mechanism
        assert await calibrations.roll_back(ROBOT, by="Ben") is None
        assert mechanism(scene) is None
        assert scene.services.runner._eye.mount == scene.services.settings.camera.mount
        with pytest.raises(NothingToRollBackError):
            await calibrations.roll_back(ROBOT, by="Ben")
        found = await calibrations.page(kind=ROBOT, before=None, limit=5)
        assert [one.version for one in found] == [2, 1], "nothing is ever forgotten"

    on_scene(scenario, parked=False)


def test_what_is_worse_on_its_own_looks_is_refused_with_how_much_worse() -> None:
    robot = Workshop.robot(3)
    looks = robot.looks(25)
    records = [
        {
            "rho1_mm": look.rho_mm[0],
            "rho2_mm": look.rho_mm[1],
            "label_mm": look.label_mm.tolist(),
            "covariance_mm2": look.covariance_mm2.ravel().tolist(),
            "residual_mm": [0.0, 0.0, 0.0],
            "weight": 1.0,
        }
        for look in looks
    ]
    evidence = RobotEvidence(looks=records, sigma={}, unseen=[], duration_s=60.0)
    turned = rotation_vector(robot.R_base_camera)

    async def scenario(scene: Scene) -> None:
        calibrations = scene.services.calibrations

        async def kept(mechanism: PlanarAsBuilt, error: float) -> str:
            found = RobotValues(mechanism=mechanism, camera_rotation_rad=turned)
            made = NewCalibration(
                found, "Anna", "A test", Grade.GOOD, error=error, evidence=evidence
            )
            return (await calibrations.keep(made)).id

        good = await kept(robot.built, 0.03)
        comparison = await calibrations.compare(good)
        assert comparison.in_force is not None
        assert comparison.in_force > 0.1, "as drawn it misses the same looks"
        await calibrations.activate(good, by="Anna", accept_worse=False)
        worse = await kept(PlanarAsBuilt.as_drawn(DRAWN), 0.9)
        with pytest.raises(CalibrationWorseError, match=r"by 0\.900 mm, the one in force by 0\.0"):
            await calibrations.activate(worse, by="Anna", accept_worse=False)
        assert mechanism(scene) == robot.built, "nothing has changed"
        await calibrations.activate(worse, by="Anna", accept_worse=True)
        assert mechanism(scene) == PlanarAsBuilt.as_drawn(DRAWN)

    on_scene(scenario, parked=False)


def test_nothing_changes_while_a_job_runs_or_the_plug_is_held() -> None:
    async def scenario(scene: Scene) -> None:
        calibrations = scene.services.calibrations
        kept = await calibrations.keep(new())
        job = await scene.start(JobType.PLUG_IN)
        with pytest.raises(ControlBusyError):
            await calibrations.activate(kept.id, by="Anna", accept_worse=False)
        await scene.ended(job)
        assert scene.services.supervisor.plug.state is PlugState.INSERTED
        with pytest.raises(CalibrationHeldError):
            await calibrations.activate(kept.id, by="Anna", accept_worse=False)
        assert mechanism(scene) is None
        assert calibrations.versions_in_force == []

    on_scene(scenario)


def test_what_cannot_be_written_down_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    async def scenario(scene: Scene) -> None:
        calibrations = scene.services.calibrations
        kept = await calibrations.keep(new())

        async def full(*_: object) -> None:
            raise StorageError("The disk is full.")

        monkeypatch.setattr(calibrations._store, "use", full)
        with pytest.raises(StorageError):
            await calibrations.activate(kept.id, by="Anna", accept_worse=False)
        assert mechanism(scene) is None
        assert scene.services.supervisor.holder is None

    on_scene(scenario, parked=False)


def test_numbers_from_elsewhere_over_the_api() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        optics = scene.services.settings.camera.optics
        camera = CameraValues(camera=optics.model_copy(update={"fx": optics.fx * 1.002}))
        entry = {"values": camera.model_dump(mode="json"), "source": "camera-0001.toml"}
        response = await client.post("calibrations", json=entry)
        assert response.status_code == 201
        kept = response.json()
        assert kept["error"] is None
        address = f"calibrations/{kept['id']}"
        refused = await client.post(f"{address}/activation", json={})
        assert "never measured" in problem(refused, 409, "calibration_worse")["detail"]
        assert scene.services.runner._eye.optics == optics
        accepted = await client.post(f"{address}/activation", json={"accept_worse": True})
        assert accepted.json()["in_force"]
        assert scene.services.runner._eye.optics == camera.camera
        now = (await client.get("calibrations/now")).json()
        assert now["in_force"]["camera"]["id"] == kept["id"]
        assert now["in_force"]["robot"] is None
        assert (await client.get(address)).json()["evidence"] is None
        (listed,) = (await client.get("calibrations", params={"kind": "camera"})).json()["items"]
        assert listed["id"] == kept["id"]
        back = await client.post("calibrations/roll-back", json={"kind": "camera"})
        assert back.json()["in_force"]["camera"] is None
        assert scene.services.runner._eye.optics == optics
        again = await client.post("calibrations/roll-back", json={"kind": "camera"})
        problem(again, 409, "calibration_nothing_before")
        problem(await client.get("calibrations/nothing"), 404, "calibration_not_found")
        small = camera.model_copy(update={"camera": optics.model_copy(update={"width": 640})})
        wrong = await client.post(
            "calibrations", json={"values": small.model_dump(mode="json"), "source": "x"}
        )
        problem(wrong, 409, "calibration_misfit")

    on_api(scenario)


def test_a_list_comes_in_pages_newest_first() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        for number in range(3):
            await scene.services.calibrations.keep(new(533.0 + number))
        page = (await client.get("calibrations", params={"limit": 2})).json()
        assert [one["version"] for one in page["items"]] == [3, 2]
        rest = (await client.get("calibrations", params={"cursor": page["next_cursor"]})).json()
        assert [one["version"] for one in rest["items"]] == [1]
        assert rest["next_cursor"] is None

    on_api(scenario)


def test_rotations_go_both_ways() -> None:
    vector = (0.02, -0.03, 3.12)
    assert rotation_vector(rotation_matrix(vector)) == pytest.approx(vector, abs=1e-9)
