"""Every private hook of the 3D library that this project uses, on the pinned version."""

from __future__ import annotations

import socket
from importlib.metadata import version

import pytest
import viser
from viser import _messages as messages

from tests.support.eventually import eventually
from tests.support.twin_client import TwinClient
from twin.scene import viser_server


def address_of(server: viser.ViserServer) -> str:
    return f"ws://{viser_server.LOOPBACK}:{server.get_port()}"


async def until_nobody_watches(server: viser.ViserServer) -> None:
    await eventually(lambda: not viser_server.watchers(server))


def test_the_hooks_are_those_of_this_version() -> None:
    assert version("viser") == "1.1.1"


def test_it_listens_on_loopback_only(server: viser.ViserServer) -> None:
    assert server.get_host() == "127.0.0.1"
    with socket.create_connection(("127.0.0.1", server.get_port()), timeout=10) as here:
        own = here.getsockname()[0]
        # A server that is stopped while it takes a connection leaves its end of it open.
        here.shutdown(socket.SHUT_WR)
        while here.recv(1000):
            pass
    assert own == "127.0.0.1"
    with socket.socket() as elsewhere, pytest.raises(OSError, match="refused"):
        elsewhere.connect(("127.0.0.2", server.get_port()))


def test_nobody_can_ask_for_a_public_tunnel(server: viser.ViserServer) -> None:
    fresh = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        as_built = fresh._websock_server._incoming_handlers
        assert as_built[messages.ShareUrlRequest]  # else this test would see nothing
    finally:
        fresh.stop()
    handlers = server._websock_server._incoming_handlers
    assert not handlers.get(messages.ShareUrlRequest)
    assert not handlers.get(messages.ShareUrlDisconnect)


def test_starting_prints_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    viser_server.open_server().stop()
    assert capfd.readouterr().out == ""


async def test_a_connection_gets_a_small_send_buffer(server: viser.ViserServer) -> None:
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        (connection,) = server._websock_server._live_connections.values()
        kernel = connection.transport.get_extra_info("socket")
        # Linux doubles what was asked for, for its own bookkeeping.
        size = kernel.getsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF)
        assert size == 2 * viser_server.SEND_BUFFER_BYTES


async def test_watchers_come_and_go(server: viser.ViserServer) -> None:
    assert viser_server.watchers(server) == 0
    async with TwinClient.connected(address_of(server)) as client:
        await client.until_replayed()
        assert viser_server.watchers(server) == 1
    await until_nobody_watches(server)
