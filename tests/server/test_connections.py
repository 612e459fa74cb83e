"""Connections that send nothing or slowly: they end, and they keep nobody out."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import socket
from collections.abc import AsyncIterator
from typing import Any

import pytest
import uvicorn

from server import connections
from server.connections import guarded
from tests.support.eventually import eventually

HELLO = b"GET / HTTP/1.1\r\nHost: robot\r\n\r\n"
MAX_IDLE = 5


async def _app(scope: Any, _receive: Any, send: Any) -> None:  # noqa: ANN401 - ASGI
    assert scope["type"] == "http"
    headers = [(b"content-length", b"2")]
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    await send({"type": "http.response.body", "body": b"ok"})


@contextlib.asynccontextmanager
async def _served(speed: float = 1.0) -> AsyncIterator[int]:
    listener = socket.create_server(("127.0.0.1", 0))
    config = uvicorn.Config(
        _app, http=guarded(speed, MAX_IDLE), lifespan="off", log_config=None, timeout_keep_alive=60
    )
    server = uvicorn.Server(config)
    running = asyncio.create_task(server.serve(sockets=[listener]))
    try:
        await eventually(lambda: server.started)
        yield listener.getsockname()[1]
    finally:
        server.should_exit = True
        await asyncio.wait_for(running, 10)
        listener.close()


Stream = tuple[asyncio.StreamReader, asyncio.StreamWriter]


async def _open(port: int, *first: bytes) -> Stream:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    for part in first:
        writer.write(part)
    await writer.drain()
    return reader, writer


async def _is_cut(stream: Stream) -> bool:
    try:
        return await stream[0].read(1) == b""
    except ConnectionError:
        return True


async def _answers(stream: Stream) -> bool:
    stream[1].write(HELLO)
    return (await stream[0].readline()).startswith(b"HTTP/1.1 200")


def _close(*streams: Stream) -> None:
    for _, writer in streams:
        writer.close()


async def test_the_oldest_silent_connection_makes_room_for_a_new_one() -> None:
    async with _served() as port:
        silent = [await _open(port) for _ in range(MAX_IDLE)]
        slow = await _open(port, b"GET / HTTP/1.1\r\nX-Slow: ")
        assert await _is_cut(silent[0])
        newcomer = await _open(port)
        assert await _answers(newcomer)
        assert await _is_cut(silent[1])
        assert await _answers(silent[4]), "who came later is still there"
        _close(*silent, slow, newcomer)


async def test_a_head_that_does_not_come_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connections, "HEAD_PATIENCE_S", 0.05)
    async with _served() as port:
        for first in ((), (b"GET / HTTP/1.1\r\nX-Slow:",), (b"GE",)):
            stream = await _open(port, *first)
            assert await asyncio.wait_for(_is_cut(stream), 5)
            _close(stream)


async def test_after_an_answer_half_a_request_is_not_waited_for_either(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(connections, "HEAD_PATIENCE_S", 0.05)
    async with _served() as port:
        stream = await _open(port)
        assert await _answers(stream)
        stream[1].write(b"GET / HTTP/1.1\r\nX-Slow:")
        rest = await asyncio.wait_for(stream[0].read(), 5)
        assert rest.endswith(b"ok")
        _close(stream)


async def test_many_requests_over_one_connection_stay_possible() -> None:
    async with _served() as port:
        stream = await _open(port)
        for _ in range(20):
            assert await _answers(stream)
            while (await stream[0].readline()) != b"\r\n":
                pass
            assert await stream[0].readexactly(2) == b"ok"
        _close(stream)


KEY = b"dGhlIHNhbXBsZSBub25jZQ=="
UPGRADE = b"GET / HTTP/1.1\r\nHost: robot\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"


@pytest.mark.parametrize(
    "nonsense",
    [
        b"\0\xff\r\n\r\n",
        b"POST / HTTP/1.1\r\nHost: robot\r\nTransfer-Encoding: chunked\r\n\r\nZZ\r\n",
        UPGRADE + b"Sec-WebSocket-Version: 13\r\n\r\n",
        UPGRADE + b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: \xc0\x80\xff==\r\n\r\n",
        UPGRADE + b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: YWJj\r\n\r\n",
        UPGRADE + b"Sec-WebSocket-Version: \x99\r\nSec-WebSocket-Key: " + KEY + b"\r\n\r\n",
    ],
    ids=["noise", "chunk", "no key", "strange key", "short key", "strange version"],
)
async def test_nonsense_is_refused_and_is_no_error_of_ours(
    nonsense: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    async with _served() as port:
        stream = await _open(port, nonsense)
        answer = await asyncio.wait_for(stream[0].read(), 5)
        assert answer.startswith(b"HTTP/1.1 400 ")
        other = await _open(port)
        assert await _answers(other)
        _close(stream, other)
    assert [record for record in caplog.records if record.levelno >= logging.ERROR] == []


async def test_nonsense_after_an_answer_has_begun_ends_the_connection(
    caplog: pytest.LogCaptureFixture,
) -> None:
    async with _served() as port:
        request = b"POST / HTTP/1.1\r\nHost: robot\r\nTransfer-Encoding: chunked\r\n\r\n"
        stream = await _open(port, request)
        assert await stream[0].readline() == b"HTTP/1.1 200 OK\r\n"
        stream[1].write(b"ZZ\r\n")
        await asyncio.wait_for(stream[0].read(), 5)
        _close(stream)
    assert [record for record in caplog.records if record.levelno >= logging.ERROR] == []
