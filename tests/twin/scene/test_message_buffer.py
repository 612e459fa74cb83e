"""Browsers that join early, late, and after a week."""

from __future__ import annotations

import asyncio
import hashlib
import inspect
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
import pytest
import viser
from viser.infra._async_message_buffer import AsyncMessageBuffer
from viser.infra._messages import Message
from websockets.exceptions import ConnectionClosedError
from websockets.protocol import State

from tests.support.eventually import eventually
from tests.support.twin_client import TwinClient
from twin.scene import message_buffer, viser_server
from twin.scene.message_buffer import ReplayBuffer, library_producer


def address_of(server: viser.ViserServer) -> str:
    return f"ws://{viser_server.LOOPBACK}:{server.get_port()}"


def buffer_of(server: viser.ViserServer) -> ReplayBuffer:
    buffer = server._websock_server._broadcast_buffer
    assert isinstance(buffer, ReplayBuffer)
    return buffer


DIGEST = "622c10d1a9e84168629a80f973fbfe02d3aa80b41d0b51b1ede6865419fdc96f"
"""Of the library's own loop."""
PRODUCER_DIGEST = "8283328d06cfa014576888930c49a857a2d79892dc89f9694444895945018ea3"
"""Of what it sends with."""


class CountingNumbers(dict[int, Any]):
    """Counts how often a number is looked up."""

    looked_up = 0

    def get(self, key: int, default: Any = None) -> Any:  # noqa: ANN401 - as dict has it
        self.looked_up += 1
        return super().get(key, default)


def digest_of(function: Callable[..., object]) -> str:
    return hashlib.sha256(inspect.getsource(function).encode()).hexdigest()


def test_what_it_replaces_is_what_it_was_written_for() -> None:
    loop, producer = digest_of(AsyncMessageBuffer._window_loop), digest_of(library_producer)
    assert loop == DIGEST, "compare ReplayBuffer with the library's new loop"
    assert producer == PRODUCER_DIGEST, "compare FramePacker and send_frames with the new one"


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


async def test_what_is_set_elsewhere_than_in_the_loop_wakes_nobody_in_between(
    server: viser.ViserServer,
) -> None:
    event = buffer_of(server).message_event
    event.set()  # this test runs in another loop than the library's
    assert not event.is_set()
    buffer_of(server).event_loop.call_soon_threadsafe(event.set)
    await eventually(event.is_set)


async def test_steps_that_replaced_each_other_before_they_were_sent_hold_nothing_up(
    server: viser.ViserServer,
) -> None:
    node = server.scene.add_frame("/node")
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        with server.atomic():
            # More than fit into one frame, and all but the last one are gone; and a week of such.
            for step in range(1, 2 * buffer_of(server).max_window_size):
                node.position = (float(step), 0.0, 0.0)
            with buffer_of(server).buffer_lock:
                buffer_of(server).message_counter += 7 * 24 * 3600 * 30 * 20
            node.position = (float(step + 1), 0.0, 0.0)
        async with asyncio.timeout(5):
            await client.until_position("/node", float(step + 1))


async def test_browsers_that_see_the_same_share_their_frames(
    server: viser.ViserServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = server.scene.add_frame("/node")
    line = server.scene.add_line_segments(
        "/line", points=np.zeros((2, 2, 3), np.float32), colors=(0, 0, 0)
    )
    packer = buffer_of(server).packer
    packed: list[int] = []
    pack = packer._packed

    def counted(window: Sequence[Message]) -> bytes:
        packed.append(len(window))
        return pack(window)

    monkeypatch.setattr(packer, "_packed", counted)
    async with (
        TwinClient.connected(address_of(server)) as first,
        TwinClient.connected(address_of(server)) as second,
    ):
        await first.until_replayed()
        await second.until_replayed()
        packed.clear()
        for step in range(1, 11):
            with server.atomic():
                node.position = (float(step), 0.0, 0.0)
                line.points = np.full((2, 2, 3), step, np.float32)
            await asyncio.gather(
                first.until_position("/node", step), second.until_position("/node", step)
            )
    assert len(packed) == 10


async def test_servers_that_were_not_changed_send_as_before(server: viser.ViserServer) -> None:
    assert buffer_of(server).packer
    other = viser.ViserServer(host=viser_server.LOOPBACK, port=0, verbose=False)
    try:
        node = other.scene.add_frame("/node")
        async with TwinClient.connected(address_of(other)) as client:
            await client.until_replayed()
            node.position = (3.0, 0.0, 0.0)
            await client.until_position("/node", 3.0)
    finally:
        other.stop()


class _Vanished:
    """A connection that the library closes after asyncio has let go of its transport."""

    def __init__(self, state: State) -> None:
        self.state = state

    async def send(self, _frame: bytes) -> None:
        raise AttributeError("'NoneType' object has no attribute 'call_soon'")


@pytest.mark.parametrize(
    ("state", "error"), [(State.CLOSED, ConnectionClosedError), (State.OPEN, AttributeError)]
)
async def test_a_browser_that_vanished_meanwhile_is_an_ended_connection(
    state: State, error: type[Exception]
) -> None:
    with pytest.raises(error):
        await message_buffer._send(cast("Any", _Vanished(state)), b"")
