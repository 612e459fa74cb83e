"""The protocol console: everything that passes while somebody looks, and nothing else."""

from __future__ import annotations

import asyncio

import httpx

from drivers.robot.traffic import Passage
from server.technician.console import KEPT, MOST_WORDS
from server.technician.tools import CONSOLE_PATIENCE_S
from tests.support.api import on_api
from tests.support.garage import Scene


async def _read(client: httpx.AsyncClient, after: int = 0) -> dict[str, object]:
    answer = await client.get("robot/frames", params={"after": after})
    assert answer.status_code == 200, answer.text
    found: dict[str, object] = answer.json()
    return found


async def _follow(client: httpx.AsyncClient, frames: list[dict[str, object]]) -> None:
    """As a page does."""
    newest = 0
    while True:
        found = await _read(client, after=newest)
        newest = int(str(found["newest"]))
        more = found["frames"]
        assert isinstance(more, list)
        frames += more


def test_nothing_is_kept_before_somebody_looks_nor_afterwards() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        console = scene.services.technician.console
        seen = [console.listening]
        await _read(client)
        seen.append(console.listening)
        await scene.later(1.0)
        assert len(console._frames) > 5, "telemetry comes all the time"
        await scene.later(2 * CONSOLE_PATIENCE_S)
        assert [*seen, console.listening] == [False, True, False]
        assert not console._frames

    on_api(scenario)


def test_commands_answers_and_refusals_pass_in_order() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        frames: list[dict[str, object]] = []
        looking = asyncio.create_task(_follow(client, frames))
        for command in ("enable", "home", "estop"):
            await scene.later(0.5)
            assert (await client.post(f"robot/{command}")).status_code == 200
        await scene.until(lambda: sum(bool(frame["error"]) for frame in frames) > 1)
        looking.cancel()
        numbers = [int(str(frame["number"])) for frame in frames]
        assert numbers == sorted(set(numbers))
        sent = [frame["kind"] for frame in frames if frame["direction"] == "to_board"]
        assert [kind for kind in sent if kind in {"Enable", "Home", "EmergencyStop"}] == [
            "Enable",
            "Home",
            "EmergencyStop",
        ]
        told = [str(frame["words"]) for frame in frames if frame["direction"] == "from_board"]
        assert any("state=HOMING" in words for words in told)
        errors = [frame for frame in frames if frame["error"]]
        assert any("fault=EMERGENCY_STOP" in str(frame["words"]) for frame in errors)
        assert len(errors) == 2, "the command and the first sample that tells of it"

    on_api(scenario)


def test_memory_is_bounded_and_what_was_lost_is_counted() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        first = int(str((await _read(client))["newest"]))
        console = scene.services.technician.console
        for number in range(3 * KEPT):
            console._take(Passage(scene.now_s, True, "Segment", "x" * 5000 + str(number)))
        found = await _read(client, after=first)
        frames = found["frames"]
        assert isinstance(frames, list)
        assert len(console._frames) == KEPT
        assert found["lost"] == int(str(found["newest"])) - first - len(frames) > KEPT
        assert max(len(frame["words"]) for frame in frames) == MOST_WORDS

    on_api(scenario)


def test_a_number_from_before_a_restart_begins_anew() -> None:
    async def scenario(_: Scene, client: httpx.AsyncClient) -> None:
        await _read(client)
        found = await _read(client, after=10_000_000)
        assert found["frames"]
        assert found["lost"] == 0

    on_api(scenario)
