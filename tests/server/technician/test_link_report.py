"""How the link does, over the API: figures of the moment, and null for what nobody measured."""

from __future__ import annotations

from typing import Any

import httpx
import pytest

from server.access import Scope
from server.technician.link_report import LinkReporter
from tests.support.api import on_api
from tests.support.garage import Scene

UNMEASURED = ("received", "damaged", "damaged_at_board", "sent_again", "supply_v")


async def _link(client: httpx.AsyncClient) -> dict[str, Any]:
    answer = await client.get("robot/link")
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def test_the_telemetry_is_told_at_rest_while_moving_and_without_a_link() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        await scene.later(3.0)
        rest = await _link(client)
        assert rest["online"]
        assert rest["telemetry_hz"] == pytest.approx(10, rel=0.1)
        assert 0 < rest["sample_delay_s"] <= 0.011
        assert rest["sample_delay_s"] <= rest["sample_age_s"] < 0.15
        numbers = scene.services.settings.simulation.parameters.board
        assert rest["round_trip"]["newest_s"] == pytest.approx(2 * numbers.command_delay_s)
        assert rest["reconnections"] == 0
        assert [rest[name] for name in UNMEASURED] == [None] * len(UNMEASURED)

        await client.post("robot/enable")
        step = {"axis": "rho3", "distance_mm": 20, "speed_mm_s": 5}
        assert (await client.post("robot/jog", json=step)).status_code == 200
        assert (await _link(client))["telemetry_hz"] == pytest.approx(100, rel=0.1)

        scene.garage.robot.unplug_link()
        await scene.later(1.0)
        gone = await _link(client)
        assert not gone["online"]
        for name in ("telemetry_hz", "sample_age_s", "sample_delay_s", "round_trip"):
            assert gone[name] is None
        scene.garage.robot.replug_link()
        await scene.later(3.0)
        assert (await _link(client))["reconnections"] == 1

    on_api(scenario, parked=True, scopes=[Scope.READ, Scope.OPERATE, Scope.SERVICE])


def test_a_driver_that_cannot_tell_leaves_what_the_telemetry_shows() -> None:
    class Silent:
        """A board without any of that."""

    async def scenario(scene: Scene, _: httpx.AsyncClient) -> None:
        telemetry, calendar = scene.services.supervisor.telemetry, scene.services.calendar
        reporter = LinkReporter(Silent(), telemetry, calendar)  # type: ignore[arg-type] # drives nothing
        report = reporter.report()
        assert report.online
        assert report.sample_age_s is not None
        assert report.round_trip is None
        assert report.reconnections is None

    on_api(scenario)
