"""Who may connect to the picture, and what gets through."""

from __future__ import annotations

import asyncio
import contextlib
import math
from collections.abc import AsyncIterator

import msgspec
import pytest
from fastapi import WebSocket
from websockets.asyncio.client import ClientConnection, connect
from websockets.asyncio.server import ServerConnection
from websockets.asyncio.server import serve as serve_websocket
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Origin, Subprotocol

from server.api.twin import bridge as bridge_module
from server.api.twin.bridge import MAX_CLIENT_MESSAGE_BYTES, SUBPROTOCOL, message_type
from tests.server.twin.conftest import Serve
from tests.support.eventually import eventually
from tests.support.twin_client import CAMERA_MESSAGE, TwinClient
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.scene import TwinHost, TwinState


class FakeLibrary(TwinHost):
    """Stands for the 3D library: keeps what it gets, sends what it is told to."""

    def __init__(self) -> None:
        super().__init__(RobotGeometry(), CameraMount(), math.radians(62.2), 4 / 3)
        self.got: asyncio.Queue[bytes] = asyncio.Queue()
        self.peers: list[ServerConnection] = []
        self.joined = asyncio.Event()
        self.left = asyncio.Event()
        self.bound: int | None = None

    @property
    def port(self) -> int | None:
        return self.bound

    async def handle(self, peer: ServerConnection) -> None:
        self.peers.append(peer)
        self.joined.set()
        try:
            async for message in peer:
                assert isinstance(message, bytes)
                self.got.put_nowait(message)
        finally:
            self.left.set()


@pytest.fixture
async def library() -> AsyncIterator[FakeLibrary]:
    library = FakeLibrary()
    async with serve_websocket(
        library.handle, "127.0.0.1", 0, subprotocols=[SUBPROTOCOL], compression=None
    ) as server:
        library.bound = next(iter(server.sockets)).getsockname()[1]
        yield library


def browser(
    address: str,
    *,
    origin: str | None = None,
    subprotocol: str = SUBPROTOCOL,
    path: str = "/twin",
) -> connect:
    return connect(
        f"ws://{address}{path}",
        origin=Origin(origin or f"http://{address}"),
        subprotocols=[Subprotocol(subprotocol)],
        compression=None,
        proxy=None,
        max_size=None,
    )


CAMERA = {k: v for k, v in msgspec.msgpack.decode(CAMERA_MESSAGE).items() if k != "type"}


def packed(kind: str, **fields: object) -> bytes:
    return msgspec.msgpack.encode({"type": kind} | fields)


async def refusal(attempt: connect) -> int:
    with pytest.raises(InvalidStatus) as refused:
        await attempt
    return refused.value.response.status_code


@pytest.mark.parametrize("path", ["/twin", "/twin/"])
async def test_frames_pass_both_ways(library: FakeLibrary, serve: Serve, path: str) -> None:
    async with serve(library) as address, browser(address, path=path) as client:
        assert client.subprotocol == SUBPROTOCOL
        await client.send(CAMERA_MESSAGE)
        assert await asyncio.wait_for(library.got.get(), 5) == CAMERA_MESSAGE
        await library.peers[0].send(b"\x01" * 300_000)
        assert await client.recv() == b"\x01" * 300_000


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "http://127.0.0.1", "null", "http://127.0.0.1:1"]
)
async def test_a_page_from_elsewhere_is_refused(
    library: FakeLibrary, serve: Serve, origin: str
) -> None:
    async with serve(library) as address:
        assert await refusal(browser(address, origin=origin)) == 403
    assert not library.peers


async def test_a_client_that_tells_no_origin_is_refused(library: FakeLibrary, serve: Serve) -> None:
    async with serve(library) as address:
        attempt = connect(f"ws://{address}/twin", subprotocols=[SUBPROTOCOL], proxy=None)
        assert await refusal(attempt) == 403


@pytest.mark.parametrize("subprotocol", ["viser-v0.0.1", "chat"])
async def test_a_client_of_another_version_is_refused(
    library: FakeLibrary, serve: Serve, subprotocol: str
) -> None:
    async with serve(library) as address:
        assert await refusal(browser(address, subprotocol=subprotocol)) == 403
    assert not library.peers


async def test_while_the_picture_is_not_ready_nobody_is_let_in(
    library: FakeLibrary, serve: Serve
) -> None:
    library.bound = None
    async with serve(library) as address:
        assert await refusal(browser(address)) == 403


async def test_only_allowed_messages_reach_the_library(library: FakeLibrary, serve: Serve) -> None:
    async with serve(library) as address, browser(address) as client:
        for kind in ("ShareUrlRequest", "GuiUpdateMessage", "RunJavascriptMessage"):
            await client.send(packed(kind))
        await client.send(CAMERA_MESSAGE)
        assert await asyncio.wait_for(library.got.get(), 5) == CAMERA_MESSAGE
        assert library.got.empty()


async def test_what_is_allowed_depends_on_who_is_connected(
    library: FakeLibrary, serve: Serve
) -> None:
    def by_query(ws: WebSocket) -> frozenset[str]:
        return frozenset({"GuiUpdateMessage"} if "technician" in ws.query_params else ())

    click = packed("GuiUpdateMessage", uuid="1")
    async with serve(library, by_query) as address, browser(address) as viewer:
        await viewer.send(click)
        async with browser(address, path="/twin?technician") as technician:
            await technician.send(click)
            assert await asyncio.wait_for(library.got.get(), 5) == click
    assert library.got.empty()


@pytest.mark.parametrize(
    "message",
    [
        b"",
        b"\xff\x00 no msgpack",
        msgspec.msgpack.encode([1, 2]),
        msgspec.msgpack.encode({"type": 7}),
        packed("ViewerCameraMessage", padding=b"x" * MAX_CLIENT_MESSAGE_BYTES),
        packed("ViewerCameraMessage", **CAMERA | {"fov": "wide"}),
        packed("ViewerCameraMessage", **CAMERA | {"wxyz": (1.0, 0.0)}),
        packed("ViewerCameraMessage", **CAMERA | {"owner": 1}),
        packed("ViewerCameraMessage"),
        "text",
    ],
    ids=["empty", "noise", "list", "number", "too long", "word", "short", "more", "less", "text"],
)
async def test_what_is_no_message_ends_the_connection(
    library: FakeLibrary, serve: Serve, message: bytes | str
) -> None:
    async with serve(library) as address, browser(address) as client:
        await client.send(message)
        with pytest.raises(ConnectionClosed) as closed:
            await asyncio.wait_for(client.recv(), 5)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1008
        await asyncio.wait_for(library.left.wait(), 5)
    assert library.got.empty()


def test_the_type_of_a_message() -> None:
    assert message_type(CAMERA_MESSAGE) == "ViewerCameraMessage"
    assert message_type(b"\x81") is None
    assert message_type(b"\x81\xa4type\xa2\xff\xfe") is None  # not UTF-8


def bridge_tasks() -> list[str]:
    return [t.get_name() for t in asyncio.all_tasks() if t.get_name().startswith("twin ")]


async def until_no_bridge_task() -> None:
    await eventually(lambda: not bridge_tasks())


async def test_a_browser_that_leaves_takes_its_upstream_along(
    library: FakeLibrary, serve: Serve
) -> None:
    async with serve(library) as address:
        async with browser(address):
            await asyncio.wait_for(library.joined.wait(), 5)
            assert len(bridge_tasks()) == 2
        await asyncio.wait_for(library.left.wait(), 5)
        await until_no_bridge_task()


async def test_a_library_that_ends_lets_the_browser_go(library: FakeLibrary, serve: Serve) -> None:
    async with serve(library) as address, browser(address) as client:
        await asyncio.wait_for(library.joined.wait(), 5)
        await library.peers[0].close()
        with pytest.raises(ConnectionClosed) as closed:
            await asyncio.wait_for(client.recv(), 5)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1012
        await until_no_bridge_task()


async def test_a_browser_that_takes_nothing_is_let_go(
    library: FakeLibrary, serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bridge_module, "SEND_TIMEOUT_S", 0.2)
    async with serve(library) as address:
        client: ClientConnection
        async with browser(address) as client:
            await asyncio.wait_for(library.joined.wait(), 5)
            client.transport.pause_reading()  # as a frozen tab does

            async def flood() -> None:
                with contextlib.suppress(ConnectionClosed):
                    while True:
                        await library.peers[0].send(b"x" * 500_000)

            await asyncio.wait_for(flood(), 10)
            await asyncio.wait_for(library.left.wait(), 5)
            client.transport.abort()
        await until_no_bridge_task()


async def test_stopping_the_server_leaves_no_task(library: FakeLibrary, serve: Serve) -> None:
    async with contextlib.AsyncExitStack() as browsers:
        async with serve(library) as address:
            for _ in range(3):
                await browsers.enter_async_context(browser(address))
            assert len(bridge_tasks()) == 6
        await until_no_bridge_task()


async def test_a_library_that_is_gone_refuses_the_browser(
    library: FakeLibrary, serve: Serve, caplog: pytest.LogCaptureFixture
) -> None:
    library.bound = 1  # nobody listens there
    async with serve(library) as address:
        assert await refusal(browser(address)) == 403
    assert "cannot be reached" in caplog.text


async def test_the_real_picture_comes_through(host: TwinHost, serve: Serve) -> None:
    async with serve(host) as address:
        host.publish(TwinState(measured=JointPosition(200, 200, 60)))
        async with TwinClient.connected(
            f"ws://{address}/twin", origin=f"http://{address}"
        ) as client:
            async with asyncio.timeout(10):
                await client.until_position("/robot/platform", 0.65)
            assert "/robot/platform/plug" in client.created
            assert 50_000 < client.received_bytes < 500_000
