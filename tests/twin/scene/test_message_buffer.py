"""Browsers that join early, late, and after a week."""

from __future__ import annotations

import asyncio
import hashlib
import inspect
from typing import Any

import pytest
import viser
from viser.infra._async_message_buffer import AsyncMessageBuffer

from tests.support.eventually import eventually
from tests.support.twin_client import TwinClient
from twin.scene import viser_server
from twin.scene.message_buffer import ReplayBuffer


def address_of(server: viser.ViserServer) -> str:
    return f"ws://{viser_server.LOOPBACK}:{server.get_port()}"


def buffer_of(server: viser.ViserServer) -> ReplayBuffer:
    buffer = server._websock_server._broadcast_buffer
    assert isinstance(buffer, ReplayBuffer)
    return buffer


DIGEST = "622c10d1a9e84168629a80f973fbfe02d3aa80b41d0b51b1ede6865419fdc96f"
"""Of the library's own loop."""


class CountingNumbers(dict[int, Any]):
    """Counts how often a number is looked up."""

    looked_up = 0

    def get(self, key: int, default: Any = None) -> Any:  # noqa: ANN401 - as dict has it
        self.looked_up += 1
        return super().get(key, default)


def test_what_it_replaces_is_what_it_was_written_for() -> None:
    source = inspect.getsource(AsyncMessageBuffer._window_loop)
    digest = hashlib.sha256(source.encode()).hexdigest()
    assert digest == DIGEST, "compare ReplayBuffer with the library's new loop"


async def test_a_late_browser_sees_the_newest_of_everything(server: viser.ViserServer) -> None:
    nodes = [server.scene.add_frame(f"/node{i}") for i in range(300)]
    removed = server.scene.add_frame("/removed")
    for step in range(20):
        nodes[0].position = (float(step + 1), 0.0, 0.0)
    nodes[1].visible = False
    removed.remove()
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        assert [n for n in client.created if n.startswith("/node")] == [
            f"/node{i}" for i in range(300)
        ]
        assert client.positions["/node0"] == pytest.approx((20, 0, 0))
        assert client.visible["/node1"] is False
        nodes[2].position = (5.0, 5.0, 5.0)
        await client.until_position("/node2", 5.0)


async def test_a_late_browser_misses_nothing_that_happens_while_it_joins(
    server: viser.ViserServer,
) -> None:
    nodes = [server.scene.add_frame(f"/node{i}") for i in range(400)]
    async with TwinClient.connected(address_of(server)) as client:
        for step in range(1, 200):
            with server.atomic():
                nodes[0].position = nodes[399].position = (float(step), 0.0, 0.0)
            await asyncio.sleep(0)
        await client.until_position("/node0", 199.0)
        await client.until_position("/node399", 199.0)


async def test_joining_after_a_week_costs_no_more_than_at_first(
    server: viser.ViserServer,
) -> None:
    node = server.scene.add_frame("/node")
    buffer = buffer_of(server)
    a_week = 7 * 24 * 3600 * 30 * 20
    with buffer.buffer_lock:
        buffer.message_counter += a_week
    node.position = (3.0, 0.0, 0.0)
    numbers = buffer.message_from_id = CountingNumbers(buffer.message_from_id)
    async with TwinClient.connected(address_of(server)) as first:
        await first.until_replayed()
        # While somebody watches, just as when nobody does.
        async with TwinClient.connected(address_of(server)) as second:
            await second.until_replayed()
            assert second.positions["/node"] == pytest.approx((3, 0, 0))
        node.position = (4.0, 0.0, 0.0)
        await first.until_position("/node", 4.0)
    assert numbers.looked_up < 1000


async def test_a_browser_that_left_holds_nothing(server: viser.ViserServer) -> None:
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        assert len(buffer_of(server).generator_cursors) == 1
    await eventually(lambda: not buffer_of(server).generator_cursors)


async def test_a_wake_up_that_got_lost_holds_nothing_up(server: viser.ViserServer) -> None:
    node = server.scene.add_frame("/node")
    buffer = buffer_of(server)
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        # As when another thread sets it between the look at it and the wait for it: it is set,
        # so that setting it again does nothing, but who waits was not told.
        await eventually(lambda: bool(buffer.message_event._waiters))
        vars(buffer.message_event)["_value"] = True
        node.position = (7.0, 0.0, 0.0)
        async with asyncio.timeout(5):
            await client.until_position("/node", 7.0)
