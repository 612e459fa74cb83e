"""Parking guidance and the simulated car over REST and the live connection."""

from __future__ import annotations

import asyncio
import contextlib
import dataclasses
import json

import httpx

from server.api.app import create_app
from server.schema.guidance import Guidance
from server.schema.simulation import SimulatedCarNow
from tests.support.api import on_api, problem
from tests.support.garage import Scene


async def _guidance(client: httpx.AsyncClient) -> Guidance:
    return Guidance.model_validate_json((await client.get("guidance")).content)


async def _car(client: httpx.AsyncClient) -> SimulatedCarNow:
    return SimulatedCarNow.model_validate_json((await client.get("simulation/car")).content)


def test_asking_makes_the_camera_look_and_a_car_that_drives_in_is_followed() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        first = await _guidance(client)
        assert (first.state, first.car, first.arriving) == ("searching", None, False)
        assert len(first.zones.good) >= 4
        order = {"type": "drive_in", "from_mm": 700, "past_mm": -100}
        told = (await client.post("simulation/car", json=order)).json()
        assert told["moving"] is True
        while not (now := await _guidance(client)).arriving:
            await scene.later(0.3)
        assert now.car is not None
        assert now.steps[0].direction == "forward"
        assert now.headline == f"{now.steps[0].shown_cm} cm forward"
        truth = await _car(client)
        assert abs(now.car.x_mm - truth.x_mm) < 3.0
        assert now.car.velocity_z_mm_s < 0

    on_api(scenario, parked=True)


def test_the_simulated_car_does_as_it_is_told() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        async def tell(**order: object) -> httpx.Response:
            return await client.post("simulation/car", json=order)

        problem(await tell(type="brake"), 409, "car_refuses")
        problem(await tell(type="drive_on", forward_mm=50), 409, "car_refuses")
        problem(await tell(type="fly"), 422, "invalid_request")
        problem(await tell(type="drive_in", past_mm=1900), 409, "car_refuses")
        assert (await tell(type="drive_in", from_mm=500, past_mm=-60)).status_code == 200
        await scene.later(0.8)
        assert (await _car(client)).speed_mm_s > 50
        await tell(type="brake")
        await scene.later(4.0)
        stopped = await _car(client)
        assert not stopped.moving
        await tell(type="drive_on", forward_mm=40)
        await scene.later(5.0)
        assert abs(stopped.z_mm - (await _car(client)).z_mm - 40) < 1.0
        await tell(type="drive_on", forward_mm=-800, steer_right_mm=None)
        await scene.later(8.0)
        await tell(type="drive_on", forward_mm=500, steer_right_mm=60)
        await scene.later(8.0)
        assert (await _car(client)).x_mm > stopped.x_mm + 5
        await tell(type="leave")
        await scene.later(25.0)
        assert (await _car(client)).z_mm > 4000

    on_api(scenario)


def test_everyone_who_watches_gets_it_pushed_at_the_pace_of_the_looks() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        stamps: list[str] = []

        async def watch() -> None:
            async for raw in scene.services.live.watch():
                message = json.loads(raw)
                section = message.get("live") or message.get("changes")
                guidance = section.get("guidance")
                if guidance and guidance["car"]:
                    stamps.append(guidance["car"]["seen_at"])

        watching = asyncio.create_task(watch())
        await client.post("simulation/car", json={"type": "drive_in", "from_mm": 500})
        await scene.later(3.0)
        watching.cancel()
        await asyncio.wait([watching])
        assert len(set(stamps)) > 15, "ten looks a second at a car that moves"

    on_api(scenario, parked=True)


def test_before_a_real_camera_there_is_no_simulated_car() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        services = dataclasses.replace(scene.services, simulated_car=None)
        app = create_app(lambda: contextlib.nullcontext(services))
        transport = httpx.ASGITransport(app)
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(
                transport=transport, base_url=client.base_url, cookies=client.cookies
            ) as other,
        ):
            problem(await other.get("simulation/car"), 409, "not_simulated")
            problem(
                await other.post("simulation/car", json={"type": "brake"}), 409, "not_simulated"
            )

    on_api(scenario)
