"""A browser's side of the 3D picture's WebSocket, without the browser."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any, Self

import msgspec
import zstandard
from websockets.asyncio.client import ClientConnection, connect
from websockets.typing import Origin, Subprotocol

from server.api.twin.bridge import SUBPROTOCOL

CAMERA_MESSAGE = msgspec.msgpack.encode(
    {
        "type": "ViewerCameraMessage",
        "wxyz": (1.0, 0.0, 0.0, 0.0),
        "position": (0.0, 0.0, 1.0),
        "fov": 1.0,
        "near": 0.01,
        "far": 100.0,
        "image_height": 400,
        "image_width": 390,
        "look_at": (0.0, 0.0, 0.0),
        "up_direction": (0.0, 1.0, 0.0),
    }
)


def unpack(frame: bytes) -> list[dict[str, Any]]:
    """The messages in one frame: sizes, then zstd-compressed msgpack, then raw arrays."""
    size, packed = (int.from_bytes(frame[i : i + 8], "little") for i in (0, 8))
    raw = zstandard.ZstdDecompressor().decompress(frame[16 : 16 + packed], max_output_size=size)
    messages: list[dict[str, Any]] = msgspec.msgpack.decode(raw)["messages"]
    return messages


class TwinClient:
    """Keeps what it was told about the nodes.

    Attributes:
        positions: Newest position of each node [m].
        visible: Newest visibility of each node.
        created: Names of all nodes, in the order they came.
        received_bytes: Size of all frames so far.
    """

    def __init__(self, connection: ClientConnection) -> None:
        self.connection = connection
        self.positions: dict[str, tuple[float, ...]] = {}
        self.visible: dict[str, bool] = {}
        self.created: list[str] = []
        self.received_bytes = 0

    @classmethod
    @asynccontextmanager
    async def connected(
        cls, address: str, *, origin: str | None = None, subprotocol: str = SUBPROTOCOL
    ) -> AsyncIterator[Self]:
        """A client that has said where its camera is, as every browser does first."""
        async with connect(
            address,
            origin=None if origin is None else Origin(origin),
            subprotocols=[Subprotocol(subprotocol)],
            compression=None,
            max_size=None,
            proxy=None,
        ) as connection:
            await connection.send(CAMERA_MESSAGE)
            yield cls(connection)

    async def receive(self) -> list[dict[str, Any]]:
        """Takes one frame in."""
        frame = await self.connection.recv(decode=False)
        self.received_bytes += len(frame)
        messages = unpack(frame)
        for message in messages:
            kind, name = message["type"], message.get("name", "")
            if kind == "SetPositionMessage":
                self.positions[name] = tuple(message["position"])
            elif kind == "SetSceneNodeVisibilityMessage":
                self.visible[name] = message["visible"]
            elif "props" in message and name.startswith("/"):
                self.created.append(name)
        return messages

    async def until_position(self, name: str, x: float) -> None:
        """Takes frames in until a node's x is what it should be."""
        while name not in self.positions or abs(self.positions[name][0] - x) > 1e-6:
            await self.receive()

    async def until_replayed(self) -> None:
        """Takes frames in until everything that was there before has come."""
        while not any(m["type"] == "ReplayDoneMessage" for m in await self.receive()):
            pass
