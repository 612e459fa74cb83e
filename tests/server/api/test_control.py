"""Two people and a program at one robot, over the API."""

from __future__ import annotations

from datetime import timedelta

import httpx

from server.access import Role, Scope
from server.api.gate.caller import COOKIE
from tests.support.api import on_api, problem
from tests.support.garage import Scene
from tests.support.pairing import new_device, new_key


async def _someone(scene: Scene, client: httpx.AsyncClient, role: Role) -> httpx.AsyncClient:
    cookie = await new_device(scene.services.access, role)
    return httpx.AsyncClient(
        transport=client._transport, base_url=client.base_url, cookies={COOKIE: cookie}
    )


def test_control_changes_hands_with_consent_only() -> None:
    async def scenario(scene: Scene, owner: httpx.AsyncClient) -> None:
        technician = await _someone(scene, owner, Role.TECHNICIAN)
        assert (await technician.post("robot/enable")).status_code == 200
        for refused in ("robot/enable", "robot/home"):
            held = problem(await owner.post(refused), 409, "control_held")
            assert held["detail"] == "Technician is in control of the robot."
        problem(await owner.post("jobs", json={"type": "unplug"}), 409, "control_held")
        assert (await owner.post("robot/stop")).status_code == 200
        assert (await owner.post("robot/reset")).status_code == 200

        asked = (await owner.post("robot/control/request")).json()
        assert asked["holder"]["person"]["name"] == "Technician"
        request = asked["request"]
        assert request["person"] == {
            "id": request["person"]["id"],
            "name": "Owner",
            "role": "owner",
        }
        answer = {"request_id": request["id"], "give": True}
        problem(await owner.post("robot/control/answer", json=answer), 409, "not_in_control")
        given = (await technician.post("robot/control/answer", json=answer)).json()
        assert given["holder"]["person"]["name"] == "Owner"
        assert given["answer"]["answer"] == "given"
        assert given == (await owner.get("robot/control")).json()
        problem(await technician.post("robot/home"), 409, "control_held")
        assert (await owner.post("robot/home")).status_code == 200
        assert (await owner.delete("robot/control")).json()["holder"] is None
        trail = await scene.services.access.audit.page(before=None, limit=50)
        assert {
            entry.detail["operation"]: (entry.actor, entry.detail["name"])
            for entry in trail
            if entry.detail.get("operation", "").startswith("control")
        } == {"control given": ("person: Technician", "Owner")}
        await technician.aclose()

    on_api(scenario)


def test_programs_and_viewers_take_no_control() -> None:
    async def scenario(scene: Scene, owner: httpx.AsyncClient) -> None:
        viewer = await _someone(scene, owner, Role.VIEWER)
        problem(await viewer.post("robot/control/request"), 403, "forbidden")
        key = await new_key(scene.services.access, Scope.OPERATE)
        program = httpx.AsyncClient(
            transport=owner._transport,
            base_url=owner.base_url,
            headers={"Authorization": f"Bearer {key}"},
        )
        assert (await program.post("robot/enable")).status_code == 200
        assert (await program.get("robot/control")).json()["holder"] is None
        problem(await program.post("robot/control/request"), 403, "people_only")
        assert (await owner.post("robot/disable")).status_code == 200
        problem(await program.post("robot/enable"), 409, "control_held")
        for client in (viewer, program):
            await client.aclose()

    on_api(scenario)


def test_no_job_begins_by_itself_under_somebodys_hands() -> None:
    async def scenario(scene: Scene, owner: httpx.AsyncClient) -> None:
        soon = (scene.services.calendar.now() + timedelta(seconds=5)).isoformat()
        planned = await owner.post("jobs", json={"type": "plug_in", "not_before": soon})
        assert planned.status_code == 202
        assert (await owner.post("robot/disable")).status_code == 200
        await scene.later(30)
        job = (await owner.get(f"jobs/{planned.json()['id']}")).json()
        assert job["state"] == "queued"
        await owner.delete("robot/control")
        await scene.until(lambda: scene.services.supervisor.holder is not None)
        assert (await owner.get(f"jobs/{job['id']}")).json()["state"] == "running"

    on_api(scenario, parked=True)
