"""Click-to-move over the network."""

from __future__ import annotations

import httpx

from tests.support.api import on_api, problem
from tests.support.garage import Scene


def test_a_preview_tells_the_way_the_time_and_the_forces_and_moves_nothing() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        here = (await client.get("robot")).json()["commanded"]["tip"]
        body = {"x_mm": here["x_mm"] + 30, "y_mm": here["y_mm"] + 40, "speed_mm_s": 10}
        answer = await client.post("robot/target", json=body)
        assert answer.status_code == 200, answer.text
        target = answer.json()
        assert target["distance_mm"] == 50
        assert target["duration_s"] > 5
        assert target["way"][0] == here
        assert target["way"][-1] == target["tip"]
        assert {each["joint"] for each in target["forces"]} == {"rho1", "rho2", "rho3"}
        assert all(0 < each["share"] < 1 for each in target["forces"])
        assert await scene.still()
        assert scene.services.technician.targets.target is not None
        assert (await client.delete("robot/target")).status_code == 204
        assert scene.services.technician.targets.target is None

    on_api(scenario, parked=True)


def test_refusals_say_why() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        far = {"x_mm": 9000, "y_mm": 300}
        problem(await client.post("robot/target", json=far), 409, "out_of_reach")
        problem(
            await client.post("robot/target", json={"x_mm": "a", "y_mm": 1}), 422, "invalid_request"
        )
        fast = {"x_mm": 600, "y_mm": 300, "speed_mm_s": 200}
        problem(await client.post("robot/target", json=fast), 422, "invalid_request")

    on_api(scenario, parked=True)


def test_a_robot_that_is_off_has_no_way() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        problem(
            await client.post("robot/target", json={"x_mm": 600, "y_mm": 300}),
            409,
            "robot_not_ready",
        )

    on_api(scenario)
