"""Robot and station over REST."""

from __future__ import annotations

from dataclasses import replace

import httpx
import pytest

from drivers.station import PilotState
from server.control.model import PlugState
from server.schema.health import Health
from server.schema.robot import Robot
from server.schema.station import Station
from tests.support.api import on_api, problem
from tests.support.garage import Scene


async def _robot(client: httpx.AsyncClient) -> Robot:
    return Robot.model_validate_json((await client.get("robot")).content)


def test_a_technician_takes_the_robot_into_use_and_jogs_it() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        step = {"axis": "x", "distance_mm": 5.0, "speed_mm_s": 20.0}
        assert (await _robot(client)).mode == "off"
        problem(await client.post("robot/jog", json=step), 409, "robot_not_ready")
        assert (await client.post("robot/enable")).json()["mode"] == "not_homed"
        problem(await client.get("robot/reach"), 409, "robot_not_ready")
        home = Robot.model_validate_json((await client.post("robot/home")).content)
        assert home.mode == "ready"
        assert home.homed
        assert home.control is None
        reach = (await client.get("robot/reach")).json()
        assert reach["x"]["on_mm"] > 100
        assert reach["rho3"]["back_mm"] == 0
        before = scene.truth().T_base_plug[0, 3]
        assert (await client.post("robot/jog", json=step)).status_code == 200
        await scene.later(0.3)
        moved_mm = scene.truth().T_base_plug[0, 3] - before
        assert 4.5 < moved_mm < 5.5
        problem(await client.post("robot/jog", json={"axis": "z"}), 422, "invalid_request")
        far = {"axis": "rho3", "distance_mm": -50.0}
        problem(await client.post("robot/jog", json=far), 409, "out_of_reach")
        assert (await client.post("robot/disable")).json()["enabled"] is False

    on_api(scenario)


def test_stops_are_never_refused() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        for _ in range(3):
            assert (await client.post("robot/stop")).json()["mode"] == "stopped"
        problem(await client.post("jobs", json={"type": "plug_in"}), 409, "stopped")
        for _ in range(3):
            assert (await client.post("robot/estop")).json()["mode"] == "emergency_stop"
        problem(await client.post("jobs", json={"type": "plug_in"}), 409, "emergency_stopped")
        assert (await client.post("robot/reset")).json()["mode"] in {"off", "ready"}
        scene.garage.robot.unplug_link()
        await scene.later(1.0)
        assert (await _robot(client)).mode == "offline"
        assert (await client.post("robot/stop")).status_code == 200
        assert (await client.post("robot/estop")).status_code == 200
        problem(await client.post("robot/reset"), 503, "robot_offline")

    on_api(scenario, parked=True)


def test_confirming_that_the_plug_is_out() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        body = {"state": "free"}
        await scene.services.supervisor.plug.doubt()
        problem(await client.post("jobs", json={"type": "plug_in"}), 409, "plug_state")
        problem(
            await client.post("robot/plug-confirmation", json={"state": "parked"}),
            422,
            "invalid_request",
        )
        answer = await client.post("robot/plug-confirmation", json=body)
        assert answer.json()["plug"] == "free"
        assert answer.json()["control"] is None
        job = (await client.post("jobs", json={"type": "plug_in"})).json()
        problem(await client.post("robot/plug-confirmation", json=body), 409, "control_busy")
        await scene.services.runner.wait()
        assert (await client.get(f"jobs/{job['id']}")).json()["error"] is None
        problem(
            await client.post("robot/plug-confirmation", json=body), 409, "lateral_motion_forbidden"
        )

    on_api(scenario, parked=True)


def test_a_person_and_the_control_pilot_must_not_contradict_each_other() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        plug, station = scene.services.supervisor.plug, scene.garage.station

        async def say(state: str) -> httpx.Response:
            return await client.post("robot/plug-confirmation", json={"state": state})

        await plug.doubt()
        for pilot in (PilotState.B, PilotState.C):
            station.lie(pilot=pilot)
            document = problem(await say("free"), 409, "plug_seen_in_car")
            assert document["context"]["pilot"] == pilot.value
            assert plug.state is PlugState.UNKNOWN
        assert (await say("inserted")).json()["plug"] == "unknown"
        station.behave()
        assert (await say("free")).json()["plug"] == "free"
        problem(await say("inserted"), 409, "plug_not_seen")
        assert plug.state is PlugState.UNKNOWN, "what forbids more counts in any case"
        assert (await _robot(client)).control is None

    on_api(scenario, parked=True)


@pytest.mark.parametrize("trouble", ["hangs", "is faulty", "is late", "senses no car"])
def test_a_station_that_cannot_tell_leaves_it_to_the_person(
    trouble: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        plug, station = scene.services.supervisor.plug, scene.garage.station
        await plug.doubt()
        station.lie(pilot=PilotState.B)
        match trouble:
            case "hangs":
                station.hang()
            case "is faulty":
                station.lie(pilot=PilotState.F)
            case "is late":
                station.set_clock(-5.0)
            case _:
                blind = replace(station.capabilities, senses_car=False)
                monkeypatch.setattr(type(station), "capabilities", blind)
        answer = await client.post("robot/plug-confirmation", json={"state": "free"})
        assert answer.json()["plug"] == "free"

    on_api(scenario, parked=True)


def test_health_names_what_is_down() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        health = Health.model_validate_json((await client.get("health")).content)
        assert health.components["robot"].status == "ok"
        assert health.components["station"].status == "ok"
        scene.garage.station.hang()
        scene.garage.robot.unplug_link()
        await scene.later(6.0)
        health = Health.model_validate_json((await client.get("health")).content)
        assert health.status == "degraded"
        assert health.components["robot"].status == "down"
        assert health.components["station"].status == "down"
        station = Station.model_validate_json((await client.get("station")).content)
        assert not station.online
        assert station.pilot == "A"  # as last read; updated_at says when

    on_api(scenario)
