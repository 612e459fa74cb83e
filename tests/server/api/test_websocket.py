"""The WebSocket of the real program on a real socket."""

from __future__ import annotations

import asyncio
import json
import statistics
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from typing import Any, Self

import httpx
import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from server.schema.live import DeltaMessage, Live, ReplyMessage, SnapshotMessage
from tests.support.process import ServerProcess, serving

SPEED = 20


@pytest.fixture(scope="module")
def server() -> Iterator[ServerProcess]:
    with serving(f"--speed={SPEED}", "--seed=4") as process:
        yield process


class Page:
    """A page that keeps the live sections as the web pages do, and checks every message."""

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection
        self.live: dict[str, Any] = {}
        self.replies: dict[int, ReplyMessage] = {}
        self.deltas = 0
        self._sequence = 0

    @classmethod
    @asynccontextmanager
    async def opened(cls, server: ServerProcess) -> AsyncIterator[Self]:
        address = server.url.replace("http", "ws") + "/api/v1/ws"
        async with connect(address, additional_headers=server.headers, proxy=None) as connection:
            page = cls(connection)
            await page.take()
            yield page

    async def say(self, **message: object) -> None:
        await self.connection.send(json.dumps(message))

    async def take(self) -> None:
        """Take one message in."""
        text = await asyncio.wait_for(self.connection.recv(decode=True), 5.0)
        match (message := json.loads(text))["type"]:
            case "snapshot":
                snapshot = SnapshotMessage.model_validate_json(text)
                self._sequence, self.live = snapshot.sequence, message["live"]
            case "delta":
                sequence = DeltaMessage.model_validate_json(text).sequence
                assert sequence == self._sequence + 1
                self._sequence = sequence
                self.deltas += 1
                self.live |= message["changes"]
            case _:
                reply = ReplyMessage.model_validate_json(text)
                self.replies[reply.id] = reply
        Live.model_validate_json(json.dumps(self.live))

    async def until_mode(self, *modes: str) -> None:
        while self.live["robot"]["mode"] not in modes:
            await self.take()

    async def reply_to(self, number: int) -> ReplyMessage:
        while number not in self.replies:
            await self.take()
        return self.replies[number]

    async def make_ready(self, client: httpx.AsyncClient) -> None:
        """Release what an earlier test left behind, and home when needed."""
        while self.live["robot"]["mode"] == "offline":
            await self.take()
        await client.post("robot/reset")
        for step in ("enable", *([] if self.live["robot"]["homed"] else ["home"])):
            answer = await client.post(f"robot/{step}")
            assert answer.status_code == 200, answer.text
        await self.until_mode("ready")

    def x_mm(self) -> float:
        return float(self.live["robot"]["commanded"]["tip"]["x_mm"])


@asynccontextmanager
async def _rest(server: ServerProcess) -> AsyncIterator[httpx.AsyncClient]:
    async with httpx.AsyncClient(
        base_url=f"{server.url}/api/v1/",
        headers=server.headers,
        trust_env=False,
        timeout=20.0,
    ) as client:
        yield client


async def test_what_is_pushed_adds_up_to_what_rest_says(server: ServerProcess) -> None:
    async with _rest(server) as client, Page.opened(server) as page:
        assert page.live["service"]["simulated"] is True
        assert page.live["service"]["speed"] == SPEED
        await page.make_ready(client)
        job = (await client.post("jobs", json={"type": "plug_in"})).json()
        while page.live["job"] is None or page.live["job"]["id"] != job["id"]:
            await page.take()
        while page.live["job"]["state"] in {"queued", "running"}:
            await page.take()
        assert page.live["job"]["error"] is None
        while page.live["job"]["recording"] is None:
            await page.take()
        assert page.live["job"] == (await client.get(f"jobs/{job['id']}")).json()
        assert page.live["robot"]["plug"] == "inserted"
        await client.post("jobs", json={"type": "unplug"})
        while page.live["job"]["type"] != "unplug" or page.live["job"]["state"] != "succeeded":
            await page.take()
        while page.live["robot"]["control"] is not None:
            await page.take()
        robot = (await client.get("robot")).json()
        for live in (robot, page.live["robot"]):
            for changing in ("updated_at", "measured"):
                live.pop(changing)
            live["socket"].pop("measured_at")  # counted back from the date of each reading
        assert page.live["robot"] == robot


async def test_a_moving_robot_is_pushed_at_20_hz_and_a_stop_at_once(
    server: ServerProcess,
) -> None:
    async with _rest(server) as client, Page.opened(server) as page:
        await page.make_ready(client)
        delays_s = []
        for number in range(1, 6):
            began_s = time.perf_counter()
            await page.say(type="stop", id=number)
            await page.until_mode("stopped")
            delays_s.append(time.perf_counter() - began_s)
            assert (await page.reply_to(number)).ok
            await client.post("robot/reset")
            await page.until_mode("ready")
        assert statistics.median(delays_s) < 0.2  # 2 to 5 ms on an idle machine

        await page.say(type="jog_step", id=9, step={"axis": "x", "distance_mm": 50.0})
        began_s, page.deltas = time.perf_counter(), 0
        assert (await page.reply_to(9)).ok
        took_s = time.perf_counter() - began_s
        assert page.deltas >= 2
        assert page.deltas <= 20 * took_s + 6  # each urgent change adds one


async def test_closing_the_socket_lets_go_of_the_button(server: ServerProcess) -> None:
    async with _rest(server) as client, Page.opened(server) as watcher:
        await watcher.make_ready(client)
        async with Page.opened(server) as page:
            start_mm = page.x_mm()
            while abs(page.x_mm() - start_mm) < 20.0:
                await page.say(type="jog", axis="x", direction=-1, speed_mm_s=20.0)
                await page.take()
        await watcher.until_mode("moving", "stopping")
        await watcher.until_mode("ready")
        while watcher.live["robot"]["control"] is not None:
            await watcher.take()
        assert abs(watcher.x_mm() - start_mm) < 20.0 + 20.0 * SPEED * 0.25


async def test_what_does_not_fit_is_answered_and_then_closed(server: ServerProcess) -> None:
    async with Page.opened(server) as page:
        await page.connection.send("{")
        reply = await page.reply_to(0)
        assert reply.problem is not None
        assert reply.problem.code == "invalid_request"
        for _ in range(30):
            await page.connection.send(b"\x00")
        with pytest.raises(ConnectionClosed) as ended:
            await page.until_mode("never")
        assert ended.value.rcvd is not None
        assert ended.value.rcvd.code == 1008
