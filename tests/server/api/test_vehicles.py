"""Vehicles over REST."""

from __future__ import annotations

import httpx

from server.schema.vehicles import Vehicle
from tests.support.api import on_api, problem
from tests.support.garage import Scene

ZOE = {"name": "Zoe", "label_size_mm": 60.0, "socket": {"x_mm": 118.5, "y_mm": -2.0}}


def test_add_change_read_forget() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        added = await client.put("vehicles/zoe", json=ZOE)
        assert added.status_code == 201
        vehicle = Vehicle.model_validate_json(added.content)
        assert vehicle.id == "zoe"
        assert vehicle.label_payload.startswith("PP2:zoe:")
        assert vehicle.socket.x_mm == 118.5
        assert vehicle.socket.z_mm == 0.0
        version = {"If-Match": added.headers["etag"]}
        renamed = {**ZOE, "name": "Amelie"}
        changed = await client.put("vehicles/zoe", json=renamed, headers=version)
        assert changed.status_code == 200
        assert (await client.get("vehicles/zoe")).json() == changed.json()
        names = [vehicle["name"] for vehicle in (await client.get("vehicles")).json()["items"]]
        assert names == ["Amelie", "Demo car"]
        assert (await client.delete("vehicles/zoe")).status_code == 204
        problem(await client.delete("vehicles/zoe"), 404, "unknown_vehicle")
        problem(await client.get("vehicles/zoe"), 404, "unknown_vehicle")

    on_api(scenario)


def test_the_vehicle_of_a_running_job_stays_as_it_is() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        job = (await client.post("jobs", json={"type": "plug_in"})).json()
        problem(await client.put("vehicles/demo", json=ZOE), 409, "vehicle_in_use")
        problem(await client.delete("vehicles/demo"), 409, "vehicle_in_use")
        assert (await client.put("vehicles/zoe", json=ZOE)).status_code == 201
        await client.post(f"jobs/{job['id']}/cancel")
        await scene.services.runner.wait()
        assert (await client.delete("vehicles/demo")).status_code == 204
        assert (await client.get(f"jobs/{job['id']}")).json()["vehicle_id"] == "demo"

    on_api(scenario)


UNFIT: list[tuple[dict[str, object], str]] = [
    ({"name": ""}, "name"),
    ({"name": "n" * 81}, "name"),
    ({"label_size_mm": 19.9}, "label_size_mm"),
    ({"label_size_mm": 1e9}, "label_size_mm"),
    ({"label_size_mm": None}, "label_size_mm"),
    ({"socket": {"x_mm": 501.0}}, "socket.x_mm"),
    ({"socket": {"rotation_x_rad": 1.0}}, "socket.rotation_x_rad"),
    ({"socket": {"w_mm": 1.0}}, "socket.w_mm"),
    ({"id": "other"}, "id"),
]


def test_what_does_not_fit_is_named() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for change, field in UNFIT:
            answer = await client.put("vehicles/zoe", json={**ZOE, **change})
            document = problem(answer, 422, "invalid_request")
            assert [fault["field"] for fault in document["context"]["fields"]] == [field], change

    on_api(scenario)


def test_ids_that_would_not_fit_on_a_label() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        for vehicle_id in ("-zoe", "a" * 65, "z%20e", "zo%C3%A9", "%22"):
            answer = await client.put(f"vehicles/{vehicle_id}", json=ZOE)
            problem(answer, 422, "invalid_request")

    on_api(scenario)
