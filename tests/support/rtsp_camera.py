"""A network camera: an RTSP 1.0 server (RFC 2326) that sends its pictures over the same connection.

Pictures carry their number, so that a test sees which one it got. It offers TCP only; a client that
asks for UDP is told so (461), as by many cameras behind a router.
"""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import struct
from collections.abc import AsyncIterator

import numpy as np
from numpy.typing import NDArray

from tests.support.rtp_jpeg import PAYLOAD_TYPE, rtp_packets

SHAPE = (96, 160)
FRAMES_PER_S = 50.0

_CELL = 16  # pixels; compression leaves the mean of a cell alone
_BITS = 16
_METHODS = "OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN, GET_PARAMETER"


def numbered_picture(number: int) -> NDArray[np.uint8]:
    """A picture that shows a number as black and white cells, shape (height, width, 3)."""
    grey = np.full(SHAPE, 90, dtype=np.uint8)
    for bit in range(_BITS):
        row, column = divmod(bit, SHAPE[1] // _CELL)
        grey[_cell(row), _cell(column)] = 230 if number >> bit & 1 else 25
    return np.repeat(grey[:, :, None], 3, axis=2)


def number_of(image: NDArray[np.uint8]) -> int:
    """The number that a picture shows, shape (height, width)."""
    number = 0
    for bit in range(_BITS):
        row, column = divmod(bit, SHAPE[1] // _CELL)
        number |= int(image[_cell(row), _cell(column)].mean() > 128) << bit
    return number


def _cell(number: int) -> slice:
    return slice(number * _CELL, (number + 1) * _CELL)


class RtspCamera:
    """One camera with a fixed port, which can be switched off and on again.

    Attributes:
        newest: Number of the picture that was sent last.
        frozen: It sends the same picture again and again.
        silent: It keeps the connection, but sends nothing any more.
        held_up: What it sends waits somewhere on the way, and comes all at once when that ends.
        asked: Methods of all requests so far.
    """

    def __init__(self) -> None:
        self.newest = 0
        self.frozen = False
        self.silent = False
        self.held_up = False
        self.asked: list[str] = []
        self._port = 0
        self._server: asyncio.Server | None = None
        self._talks: dict[asyncio.Task[None], asyncio.StreamWriter] = {}

    @property
    def url(self) -> str:
        return f"rtsp://127.0.0.1:{self._port}/stream"

    async def switch_on(self) -> None:
        """Listen; the second time on the same port."""
        self._server = await asyncio.start_server(self._talk, "127.0.0.1", self._port)
        self._port = self._server.sockets[0].getsockname()[1]

    async def switch_off(self) -> None:
        """Hang up on everybody, without a farewell."""
        server, self._server = self._server, None
        if server is None:
            return
        server.close()
        for writer in self._talks.values():
            writer.transport.abort()
        await asyncio.gather(*self._talks)
        await server.wait_closed()

    async def _talk(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        talk = asyncio.current_task()
        assert talk is not None
        self._talks[talk] = writer
        playing: asyncio.Task[None] | None = None
        try:
            while True:
                request = await _request(reader)
                method = request.split(" ", 1)[0]
                self.asked.append(method)
                writer.write(self._answer(method, request))
                await writer.drain()
                if method == "TEARDOWN":
                    return
                if method == "PLAY" and playing is None:
                    playing = asyncio.create_task(self._play(writer))
        except (asyncio.IncompleteReadError, ConnectionError):
            return  # the client has hung up
        finally:
            del self._talks[talk]
            if playing is not None:
                playing.cancel()
                await asyncio.gather(playing, return_exceptions=True)
            writer.transport.abort()

    def _answer(self, method: str, request: str) -> bytes:
        lines = [f"CSeq: {_header(request, 'CSeq')}", "Session: 4711;timeout=60"]
        status, body = "200 OK", ""
        if method == "OPTIONS":
            lines.append(f"Public: {_METHODS}")
        elif method == "DESCRIBE":
            body = "\r\n".join(
                (
                    "v=0",
                    "o=- 1 1 IN IP4 127.0.0.1",
                    "s=Garage",
                    "t=0 0",
                    f"m=video 0 RTP/AVP {PAYLOAD_TYPE}",
                    f"a=framerate:{FRAMES_PER_S:g}",
                    "a=control:video",
                    "",
                )
            )
            lines += [f"Content-Base: {self.url}/", "Content-Type: application/sdp"]
        elif method == "SETUP":
            if "/TCP" in _header(request, "Transport"):
                lines.append("Transport: RTP/AVP/TCP;unicast;interleaved=0-1")
            else:
                status = "461 Unsupported Transport"
        lines.append(f"Content-Length: {len(body)}")
        return "\r\n".join((f"RTSP/1.0 {status}", *lines, "", body)).encode()

    async def _play(self, writer: asyncio.StreamWriter) -> None:
        """Send pictures at an even pace; a machine that is too slow makes up for it afterwards."""
        loop = asyncio.get_running_loop()
        began_s, sequence = loop.time(), 0
        waiting = bytearray()
        for taken in itertools.count(1):
            taken_s = taken / FRAMES_PER_S
            await asyncio.sleep(max(0.0, began_s + taken_s - loop.time()))
            if self.silent:
                continue
            self.newest += not self.frozen
            picture = numbered_picture(self.newest)
            for packet in rtp_packets(picture, sequence=sequence, time_s=taken_s):
                waiting += struct.pack(">cBH", b"$", 0, len(packet)) + packet
                sequence += 1
            if not self.held_up:
                writer.write(bytes(waiting))
                waiting.clear()
                await writer.drain()


async def _request(reader: asyncio.StreamReader) -> str:
    """The next request; what the client says about reception (RTCP) is passed over."""
    while True:
        first = await reader.readexactly(1)
        if first != b"$":
            return (first + await reader.readuntil(b"\r\n\r\n")).decode()
        _, length = struct.unpack(">BH", await reader.readexactly(3))
        await reader.readexactly(length)


def _header(request: str, name: str) -> str:
    for line in request.split("\r\n"):
        if line.lower().startswith(f"{name.lower()}:"):
            return line.split(":", 1)[1].strip()
    return ""


@contextlib.asynccontextmanager
async def rtsp_camera() -> AsyncIterator[RtspCamera]:
    """A camera that is switched on, and off in the end."""
    camera = RtspCamera()
    await camera.switch_on()
    try:
        yield camera
    finally:
        await camera.switch_off()
