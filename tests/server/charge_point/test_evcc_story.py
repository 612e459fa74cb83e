"""An energy manager uses the robot as its charger, and people use it as well."""

from __future__ import annotations

import httpx
import pytest

from server.control.model import PlugState
from server.jobs.model import JobPhase, JobState, JobType
from tests.support.api import on_api, problem
from tests.support.garage import Scene

Client = httpx.AsyncClient


async def read(client: Client) -> dict[str, object]:
    answer = await client.get("charge-point")
    assert answer.status_code == 200, answer.text
    content: dict[str, object] = answer.json()
    return content


async def enable(client: Client, *, enabled: bool) -> httpx.Response:
    return await client.put("charge-point/enabled", json={"enabled": enabled})


async def until_charging(scene: Scene, client: Client) -> None:
    answer = await enable(client, enabled=True)
    assert answer.status_code == 200, answer.text
    await scene.until_phase(JobPhase.CHARGING)
    await scene.later(6.0)


def test_enabled_it_plugs_in_and_charges_and_disabled_it_pauses() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        parked = await read(client)
        assert (parked["cp_state"], parked["robot_state"]) == ("B", "parked"), "virtual B"
        assert parked["enabled"] is False
        await until_charging(scene, client)
        charging = await read(client)
        assert (charging["cp_state"], charging["robot_state"]) == ("C", "charging")
        assert charging["enabled"] is True
        assert charging["contactor_closed"] is True
        assert float(str(charging["power_w"])) > 7000

        assert (await enable(client, enabled=False)).status_code == 200
        await scene.later(5.0)
        paused = await read(client)
        assert (paused["cp_state"], paused["robot_state"]) == ("B", "paused")
        assert paused["power_w"] == 0.0
        assert scene.truth().seated, "disabled does not mean unplugged"
        await scene.later(60.0)
        assert scene.truth().seated, "nor does the job end because nothing flows"

        assert (await enable(client, enabled=True)).status_code == 200
        await scene.later(10.0)
        again = await read(client)
        assert again["cp_state"] == "C"
        assert float(str(again["energy_kwh"])) >= float(str(paused["energy_kwh"]))
        job = scene.services.runner.newest
        assert job is not None
        assert job.type is JobType.CHARGE
        assert len(await scene.services.jobs.page(before=None, limit=10)) == 1, "one job for all"

    on_api(scenario, parked=True)


def test_after_somebody_has_unplugged_it_reports_a_until_it_is_resumed() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await until_charging(scene, client)
        job = scene.services.runner.newest
        assert job is not None
        assert (await client.post(f"jobs/{job.id}/cancel")).status_code == 202
        await scene.later(1.0)
        resting = await read(client)
        assert (resting["resting"], resting["enabled"]) == ("unplugged", False)
        refused = await enable(client, enabled=True)
        problem(refused, 409, "charge_point_resting")
        await scene.ended(job)
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert (await read(client))["cp_state"] == "A"
        problem(await enable(client, enabled=True), 409, "charge_point_resting")
        assert scene.services.runner.newest is not None
        assert scene.services.runner.newest.id == job.id, "the robot has not begun again"

        assert (await client.post("charge-point/resume")).json()["cp_state"] == "B"
        assert (await enable(client, enabled=True)).status_code == 200
        await scene.until(lambda: scene.services.supervisor.mode.value == "moving")

    on_api(scenario, parked=True)


def test_a_job_begun_by_hand_ends_the_rest() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        assert (await read(client))["cp_state"] == "B"
        await scene.carried_out(JobType.UNPLUG)
        assert (await read(client))["resting"] == "unplugged"
        await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.LOCATING)
        assert (await read(client))["resting"] is None

    on_api(scenario, parked=True)


def test_a_car_that_somebody_plugged_in_gets_energy_without_a_job() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        assert (await enable(client, enabled=True)).status_code == 200
        await scene.later(6.0)
        assert (await read(client))["cp_state"] == "C"
        assert (await enable(client, enabled=False)).status_code == 200
        await scene.later(3.0)
        assert (await read(client))["cp_state"] == "B"
        assert scene.truth().seated

    on_api(scenario, parked=True)


def test_a_charged_car_is_unplugged_and_not_plugged_in_again() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        scene.garage.world.wanted_wh = 30.0
        await until_charging(scene, client)
        await scene.services.runner.wait()
        done = await read(client)
        assert (done["cp_state"], done["resting"], done["enabled"]) == ("A", "charged", False)
        assert float(str(done["energy_kwh"])) == pytest.approx(0.030, abs=0.002)
        problem(await enable(client, enabled=True), 409, "charge_point_resting")

    on_api(scenario, parked=True)


def test_a_job_that_fails_is_tried_again_only_as_often_as_configured() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        async def nowhere(*_: object, **__: object) -> None:
            return None

        scene.services.runner._eye.look = nowhere  # type: ignore[method-assign]
        attempts = scene.services.settings.charge_point.attempts
        for _ in range(attempts):
            assert (await read(client))["cp_state"] == "B"
            assert (await enable(client, enabled=True)).status_code == 200
            await scene.services.runner.wait()
            newest = scene.services.runner.newest
            assert newest is not None
            assert newest.state is JobState.FAILED
            assert (await read(client))["enabled"] is False, "evcc must see that it did not work"
        assert (await read(client))["resting"] == "failed"
        problem(await enable(client, enabled=True), 409, "charge_point_resting")

    on_api(scenario, parked=True)


def test_the_current_is_passed_on() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        answer = await client.put("charge-point/max-current", json={"max_current_a": 10})
        assert answer.status_code == 200
        assert (answer.json()["max_current_a"], answer.json()["limits_current"]) == (10.0, True)
        await until_charging(scene, client)
        currents = (await read(client))["currents_a"]
        assert isinstance(currents, list)
        assert currents[0] == pytest.approx(10.0, rel=0.02)
        for wrong in (5.9, 81, "ten", None, float("inf")):
            content = f'{{"max_current_a": {"Infinity" if wrong == float("inf") else wrong}}}'
            answer = await client.put("charge-point/max-current", content=content)
            assert answer.status_code in {400, 422}, wrong
            assert answer.headers["content-type"] == "application/problem+json"

    on_api(scenario, parked=True)


def test_what_cannot_be_plugged_in_is_no_car() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        supervisor = scene.services.supervisor
        await supervisor.emergency_stop()
        await scene.later(1.0)
        assert (await read(client))["cp_state"] == "F"
        assert (await read(client))["robot_state"] == "fault"
        answer = await enable(client, enabled=True)
        assert answer.status_code == 409, answer.text
        assert (await read(client))["enabled"] is False
        await supervisor.reset()
        scene.garage.station.hang()
        await scene.later(8.0)
        silent = await read(client)
        assert (silent["cp_state"], silent["power_w"]) == ("E", 0.0)

    on_api(scenario, parked=True)
