"""Whatever is at the other end of an address: a named error, in time, with advice."""

from __future__ import annotations

import asyncio

import pytest

from drivers.station import (
    StationAnswerError,
    StationError,
    StationNotOpenError,
    StationRefusedError,
    StationSilentError,
    StationUnreachableError,
)
from drivers.station.web import Answer, WebDevice
from tests.support.fake_stations.serving import answering, http


class Reading(Answer):
    amp: float


GOOD = http(b'{"amp": 6.5}')


async def read(*answers: bytes | None, timeout_s: float = 3.0) -> float:
    async with answering(*answers) as url:
        web = WebDevice("Wallbox", url, timeout_s)
        web.open()
        try:
            reading, _ = await web.read(Reading, "/status")
            return reading.amp
        finally:
            await web.close()


async def test_a_good_answer() -> None:
    assert await read(GOOD) == 6.5


@pytest.mark.parametrize(
    ("answer", "error", "advice"),
    [
        (http(b"<html>Login</html>", kind="text/html"), StationAnswerError, "address"),
        (http(b'{"amp": "6.5"}'), StationAnswerError, "amp"),
        (http(b'{"amp": NaN}'), StationAnswerError, "amp"),
        (http(b'{"amp": true}'), StationAnswerError, "amp"),
        (http(b"[]"), StationAnswerError, "firmware"),
        (http(b""), StationAnswerError, "firmware"),
        (http(b"\xff\xfe"), StationAnswerError, "firmware"),
        (http(b"[" * 100_000), StationAnswerError, "firmware"),
        (http(b" " * 1_100_000), StationAnswerError, "without an end"),
        (http(b'{"amp"', length=100), StationUnreachableError, "network"),
        (b"", StationUnreachableError, "network"),
        (b"SSH-2.0-OpenSSH\r\n", StationUnreachableError, "network"),
        (b"HTTP/1.1 302 Found\r\nLocation: /login\r\n\r\n", StationRefusedError, "302"),
        (b"HTTP/1.1 500 No\r\nContent-Length: 0\r\n\r\n", StationRefusedError, "500"),
    ],
)
async def test_what_is_no_answer(answer: bytes, error: type[StationError], advice: str) -> None:
    with pytest.raises(error, match=advice):
        await read(answer)


async def test_one_dropped_connection_is_tried_again() -> None:
    assert await read(http(b'{"amp"', length=100), GOOD) == 6.5


async def test_silence_ends_in_time() -> None:
    began_s = asyncio.get_running_loop().time()
    with pytest.raises(StationSilentError, match="did not answer"):
        await read(None, timeout_s=0.2)
    assert asyncio.get_running_loop().time() - began_s < 3.0


async def test_silence_in_the_middle_ends_in_time() -> None:
    async with asyncio.timeout(20.0):
        stuck = asyncio.Event()

        async def talk(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            writer.write(http(b'{"amp"', length=100))
            await stuck.wait()
            writer.close()

        async with await asyncio.start_server(talk, "127.0.0.1", 0) as server:
            port = server.sockets[0].getsockname()[1]
            web = WebDevice("Wallbox", f"http://127.0.0.1:{port}", 0.2)
            web.open()
            with pytest.raises(StationSilentError):
                await web.read(Reading, "/status")
            await web.close()
            stuck.set()


async def test_nobody_there() -> None:
    async with answering(GOOD) as url:
        pass
    web = WebDevice("Wallbox", url, 3.0)
    with pytest.raises(StationNotOpenError):
        await web.read(Reading, "/status")
    web.open()
    with pytest.raises(StationUnreachableError, match="configuration"):
        await web.read(Reading, "/status")
    await web.close()
    await web.close()
