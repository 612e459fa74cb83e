"""The WebSocket's server side against a client that does as it likes, in virtual time."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable
from typing import Any, cast

import pytest
from fastapi import WebSocket
from starlette.datastructures import State

from server.access import Caller, Need
from server.api.routes.live import MAX_INVALID, MAX_UNANSWERED, live
from tests.support.garage import Scene, on_scene


class Client:
    """Stands in for the socket; the test is the page behind it.

    Attributes:
        taken: Messages that the client has taken.
        takes: Set while the client takes messages.
        closed: Code with which the server closed.
    """

    def __init__(self, scene: Scene) -> None:
        self.taken: list[dict[str, Any]] = []
        self.takes = asyncio.Event()
        self.takes.set()
        self.closed: int | None = None
        self.state = State({"caller": Caller("machine", "", "", frozenset(Need), "")})
        self._incoming: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self.served = asyncio.create_task(live(cast("WebSocket", self), scene.services))

    # what the page does

    def say(self, **message: object) -> None:
        self.say_raw(json.dumps(message))

    def say_raw(self, text: str) -> None:
        self._incoming.put_nowait({"type": "websocket.receive", "text": text})

    def say_bytes(self, data: bytes) -> None:
        self._incoming.put_nowait({"type": "websocket.receive", "bytes": data})

    async def leave(self) -> None:
        self._incoming.put_nowait({"type": "websocket.disconnect", "code": 1001})
        await self.served

    def replies(self) -> dict[int, dict[str, Any]]:
        return {m["id"]: m for m in self.taken if m["type"] == "reply"}

    # what the server sees

    async def accept(self) -> None:
        pass

    async def receive(self) -> dict[str, Any]:
        return await self._incoming.get()

    async def send_text(self, text: str) -> None:
        await self.takes.wait()
        self.taken.append(json.loads(text))

    async def close(self, code: int, reason: str) -> None:
        assert reason
        self.closed = code


def _with_client(
    scenario: Callable[[Scene, Client], Awaitable[None]], *, parked: bool = True
) -> None:
    async def with_client(scene: Scene) -> None:
        client = Client(scene)
        try:
            await scenario(scene, client)
        finally:
            if not client.served.done():
                await client.leave()
        assert scene.services.live.watchers == 0

    on_scene(with_client, seed=4, parked=parked)


def _x_mm(scene: Scene) -> float:
    return float(scene.truth().T_base_plug[0, 3])


def test_a_client_that_falls_behind_gets_the_newest_and_no_backlog() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await scene.later(0.2)
        client.takes.clear()
        client.taken.clear()
        client.say(type="jog_step", id=1, step={"axis": "x", "distance_mm": 20.0})
        await scene.later(5.0)
        client.takes.set()
        await scene.later(0.01)
        deltas = [m for m in client.taken if m["type"] == "delta"]
        assert len(deltas) <= 3  # the one that was on its way, the newest, and one that followed
        shown = deltas[-1]["changes"]["robot"]
        assert shown["mode"] == "ready"
        newest = scene.services.supervisor.telemetry.require()
        assert shown["updated_at"].startswith(
            scene.services.calendar.at(newest.sampled_at_s).isoformat()[:19]
        )
        assert client.replies()[1]["ok"]

    _with_client(scenario)


def test_a_stop_waits_neither_for_a_step_nor_for_a_client_that_takes_no_answer() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        client.say(type="jog_step", id=1, step={"axis": "x", "distance_mm": 40.0})
        await scene.until_moving()
        client.takes.clear()
        client.say(type="stop", id=2)
        client.say(type="emergency_stop", id=3)
        await scene.later(0.02)
        assert scene.services.supervisor.mode == "emergency_stop"
        await scene.later(0.5)
        assert await scene.still()
        client.takes.set()
        await scene.later(0.1)
        replies = client.replies()
        assert replies[1]["problem"]["code"] in {"stopped", "emergency_stopped"}
        assert replies[2]["ok"]
        assert replies[3]["ok"]

    _with_client(scenario)


def test_a_stop_said_in_leaving_is_carried_out() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        client.say(type="stop")
        await client.leave()
        assert scene.services.supervisor.mode == "stopped"

    _with_client(scenario)


@pytest.mark.parametrize("how", ["silence", "jog_end", "leave", "other axis"])
def test_a_held_button_moves_until_it_is_not_held(how: str) -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        held = {"type": "jog", "axis": "x", "direction": 1, "speed_mm_s": 20.0}
        start_mm = _x_mm(scene)
        for _ in range(15):
            client.say(**held)
            await scene.later(0.1)
        assert _x_mm(scene) - start_mm > 15.0
        holder = scene.services.supervisor.holder
        assert holder is not None
        assert holder.kind == "jog"
        if how == "jog_end":
            client.say(type="jog_end")
        elif how == "leave":
            await client.leave()
        elif how == "other axis":
            client.say(**{**held, "direction": -1})
        released_mm = _x_mm(scene)
        await scene.later(0.6)
        assert await scene.still()
        rolled_on_mm = _x_mm(scene) - released_mm
        assert rolled_on_mm < (20.0 * 0.25 if how == "silence" else 0.0) + 2.0
        assert scene.services.supervisor.holder is None

    _with_client(scenario)


def test_a_step_ends_when_its_client_leaves() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        client.say(type="jog_step", step={"axis": "x", "distance_mm": 50.0, "speed_mm_s": 10.0})
        await scene.until_moving()
        await client.leave()
        assert await scene.still()
        assert scene.services.supervisor.holder is None
        assert scene.services.supervisor.mode == "ready"

    _with_client(scenario)


def test_messages_that_do_not_fit_are_answered_and_then_enough_is_enough() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        client.say_raw("not JSON")
        client.say_bytes(b"\xff\x00")
        client.say(type="dance", id=5)
        client.say(type="jog", axis="x", direction=2)
        client.say(type="jog", axis="x", direction=1, speed_mm_s=1000.0)
        client.say_raw('{"type": "jog", "axis": "x", "direction": 1, "speed_mm_s": NaN}')
        client.say_raw("[" * 50_000)
        await scene.later(0.01)
        refused = [m for m in client.taken if m["type"] == "reply"]
        assert len(refused) == 7
        assert {m["problem"]["code"] for m in refused} == {"invalid_request"}
        assert scene.services.supervisor.holder is None

        client.say_bytes(b'{"type": "resync", "id": 8}')  # a binary frame is JSON as well
        await scene.later(0.01)
        assert client.replies()[8]["ok"]
        for _ in range(MAX_INVALID):
            client.say_raw("{}")
        await asyncio.wait_for(client.served, 1.0)
        assert client.closed == 1008

    _with_client(scenario)


def test_a_client_that_never_takes_an_answer_is_sent_away() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await scene.later(0.1)
        client.takes.clear()
        for number in range(MAX_UNANSWERED + 1):
            client.say(type="jog_end", id=number)
        await asyncio.wait_for(client.served, 1.0)
        assert client.closed == 1008

    _with_client(scenario)


def test_a_message_that_fails_inside_is_told_without_the_inside(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        def explode(*_: object) -> None:
            raise ZeroDivisionError("the secret is 42")

        monkeypatch.setattr(scene.services.jog, "hold", explode)
        client.say(type="jog", id=1, axis="x", direction=1)
        await scene.later(0.01)
        reply = client.replies()[1]
        assert reply["problem"]["code"] == "internal"
        assert "42" not in json.dumps(reply)
        assert "the secret is 42" in caplog.text
        client.say(type="stop", id=2)
        await scene.later(0.1)
        assert client.replies()[2]["ok"]

    _with_client(scenario)


def test_resync_begins_anew() -> None:
    async def scenario(scene: Scene, client: Client) -> None:
        await scene.later(1.0)
        client.taken.clear()
        client.say(type="resync")
        await scene.later(0.3)
        assert client.taken[0]["type"] == "snapshot"
        sequences = [m["sequence"] for m in client.taken]
        assert sequences == list(range(1, len(sequences) + 1))
        assert scene.services.live.watchers == 1

    _with_client(scenario)
