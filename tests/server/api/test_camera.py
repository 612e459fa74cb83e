"""Pictures of the real program: single ones and the stream."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager

import cv2
import httpx
import numpy as np
import pytest
import zxingcpp

from drivers.simulator.camera.imaging import CameraFault
from tests.support.api import on_api, problem
from tests.support.eventually import eventually
from tests.support.garage import Scene
from tests.support.process import ServerProcess, serving


@pytest.fixture(scope="module")
def server() -> Iterator[ServerProcess]:
    with serving("--speed=10", "--seed=4") as process:
        yield process


@asynccontextmanager
async def _stream(server: ServerProcess) -> AsyncIterator[AsyncIterator[bytes]]:
    """The JPEGs of the stream, as a browser cuts them out of it."""
    address = f"{server.url}/api/v1/camera/stream.mjpg"
    async with (
        httpx.AsyncClient(headers=server.headers, trust_env=False, timeout=10.0) as client,
        client.stream("GET", address) as response,
    ):
        kind, _, boundary = response.headers["content-type"].partition("; boundary=")
        assert kind == "multipart/x-mixed-replace"
        assert response.headers["cache-control"] == "no-store"
        yield _pictures(response.aiter_bytes(), b"--" + boundary.encode() + b"\r\n")


async def _pictures(chunks: AsyncIterator[bytes], boundary: bytes) -> AsyncIterator[bytes]:
    received = b""
    async for chunk in chunks:
        received += chunk
        while b"\r\n\r\n" in received:
            head, _, rest = received.partition(b"\r\n\r\n")
            assert head.startswith(boundary + b"Content-Type: image/jpeg\r\nContent-Length: ")
            length = int(head.rsplit(b" ", 1)[1])
            if len(rest) < length + 2:
                break
            assert rest[length : length + 2] == b"\r\n"
            yield rest[:length]
            received = rest[length + 2 :]


def _decoded(jpeg: bytes) -> np.ndarray:
    image = cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    return image


async def _done(client: httpx.AsyncClient, address: str) -> bool:
    return (await client.post(address, timeout=20.0)).status_code == 200


async def test_a_snapshot_shows_the_label(server: ServerProcess) -> None:
    async with httpx.AsyncClient(headers=server.headers, trust_env=False) as client:
        await eventually(lambda: _done(client, f"{server.url}/api/v1/robot/enable"))
        assert await _done(client, f"{server.url}/api/v1/robot/home")
        answer = await client.get(f"{server.url}/api/v1/camera/snapshot.jpg")
    assert answer.headers["content-type"] == "image/jpeg"
    assert answer.headers["cache-control"] == "no-store"
    image = _decoded(answer.content)
    (code,) = zxingcpp.read_barcodes(image)
    assert code.text.startswith("PP2:demo:")


async def test_viewers_share_the_stream_and_come_and_go(server: ServerProcess) -> None:
    async with _stream(server) as first:
        seen = [await anext(first) for _ in range(3)]
        async with _stream(server) as second:
            shared = [await anext(second) for _ in range(3)]
        seen += [await anext(first) for _ in range(6)]
    assert {_decoded(jpeg).shape for jpeg in seen} == {_decoded(shared[0]).shape}
    assert set(shared) & set(seen), "every viewer got pictures of its own"
    async with _stream(server) as again:
        assert _decoded(await anext(again)).size


def test_a_camera_that_is_down_is_a_problem_and_comes_back() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        scene.garage.camera.fault = CameraFault.UNPLUGGED
        problem(await client.get("camera/snapshot.jpg"), 503, "camera_down")
        problem(await client.get("camera/stream.mjpg"), 503, "camera_down")
        health = (await client.get("health")).json()
        assert health["components"]["camera"]["status"] == "down"
        scene.garage.camera.fault = CameraFault.NONE
        assert (await client.get("camera/snapshot.jpg")).status_code == 200

    on_api(scenario)


def test_production_ends_with_the_last_viewer() -> None:
    async def scenario(scene: Scene, _: httpx.AsyncClient) -> None:
        feed = scene.services.camera
        pictures = feed.stream()
        await anext(pictures)
        producer = feed._task
        assert producer is not None
        await pictures.aclose()  # type: ignore[attr-defined]  # it is a generator
        await scene.later(1.0)
        assert producer.done()

    on_api(scenario)
