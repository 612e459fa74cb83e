from __future__ import annotations

import asyncio

import cv2
import numpy as np
import pytest

from drivers.camera import CameraError, CameraTimeoutError, Frame
from server.live.camera_feed import STREAM_WIDTH_PX, CameraFeed
from tests.support.virtual import run_virtual


class Camera:
    """Counts the pictures it is asked for."""

    name = "Test camera"

    def __init__(self, shape: tuple[int, int] = (1232, 1640)) -> None:
        self.frames = 0
        self.failure: Exception | None = None
        self.answer_s = 0.03
        self._shape = shape

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        del exposed_after_s  # the protocol's; every picture of this camera is new
        await asyncio.sleep(self.answer_s)
        if self.failure is not None:
            raise self.failure
        self.frames += 1
        image = np.full(self._shape, self.frames % 256, dtype=np.uint8)
        return Frame(image, asyncio.get_running_loop().time(), self.frames)


async def view(feed: CameraFeed, pictures: list[bytes], count: int = 10**9) -> None:
    async for picture in feed.stream():
        pictures.append(picture)
        if len(pictures) == count:
            return


def decoded(picture: bytes) -> np.ndarray:
    image = cv2.imdecode(np.frombuffer(picture, np.uint8), cv2.IMREAD_GRAYSCALE)
    assert image is not None
    return image


def test_all_viewers_share_the_pictures_of_one_camera() -> None:
    async def scenario() -> None:
        camera = Camera()
        feed = CameraFeed(camera, 0.2)
        seen: list[list[bytes]] = [[] for _ in range(5)]
        tasks = [asyncio.create_task(view(feed, pictures)) for pictures in seen]
        await asyncio.sleep(2.1)
        for task in tasks:
            task.cancel()
        await asyncio.wait(tasks)
        assert 10 <= camera.frames <= 12
        assert all(pictures == seen[0] for pictures in seen)
        assert decoded(seen[0][3]).shape == (616, STREAM_WIDTH_PX)
        assert abs(float(decoded(seen[0][3]).mean()) - 4) < 1.0

    run_virtual(scenario())


def test_the_camera_rests_when_the_last_viewer_has_gone_and_works_again_for_the_next() -> None:
    async def scenario() -> None:
        camera = Camera()
        feed = CameraFeed(camera, 0.2)
        await asyncio.sleep(1.0)
        assert camera.frames == 0
        await view(feed, [], count=3)
        await asyncio.sleep(0.5)
        frames = camera.frames
        await asyncio.sleep(10.0)
        assert camera.frames == frames
        fresh: list[bytes] = []
        await view(feed, fresh, count=1)
        assert decoded(fresh[0])[0, 0] == pytest.approx(frames + 1, abs=1), "not an old picture"

    run_virtual(scenario())


@pytest.mark.parametrize(
    "failure", [CameraError("unplugged"), CameraTimeoutError("no frame"), MemoryError()]
)
def test_a_camera_that_fails_ends_all_streams_and_serves_who_comes_later(
    failure: Exception,
) -> None:
    async def scenario() -> None:
        camera = Camera()
        feed = CameraFeed(camera, 0.2)
        viewers = [asyncio.create_task(view(feed, [])) for _ in range(3)]
        await asyncio.sleep(1.0)
        camera.failure = failure
        _, waiting = await asyncio.wait(viewers, timeout=1.0)
        assert not waiting
        assert all(viewer.exception() is failure for viewer in viewers)
        assert feed.online is not isinstance(failure, CameraError)
        # somebody looks again at once, and once more when it works
        with pytest.raises(type(failure)):
            await asyncio.wait_for(view(feed, []), 1.0)
        camera.failure = None
        await asyncio.wait_for(view(feed, [], count=2), 2.0)
        assert feed.online

    run_virtual(scenario())


def test_closing_lets_every_viewer_go() -> None:
    async def scenario() -> None:
        feed = CameraFeed(Camera(), 0.2)
        viewers = [asyncio.create_task(view(feed, [])) for _ in range(3)]
        await asyncio.sleep(1.0)
        await feed.close()
        _, waiting = await asyncio.wait(viewers, timeout=1.0)
        assert not waiting
        assert [viewer.exception() for viewer in viewers] == [None] * 3
        await asyncio.wait_for(view(feed, []), 1.0)

    run_virtual(scenario())


def test_a_single_picture_is_full_size_and_tells_whether_the_camera_works() -> None:
    async def scenario() -> None:
        camera = Camera((300, 400))
        feed = CameraFeed(camera, 0.2)
        assert decoded(await feed.snapshot()).shape == (300, 400)
        camera.failure = CameraError("unplugged")
        with pytest.raises(CameraError):
            await feed.snapshot()
        assert not feed.online
        camera.failure = None
        await feed.snapshot()
        assert feed.online

    run_virtual(scenario())


def test_a_small_picture_is_not_blown_up() -> None:
    async def scenario() -> None:
        pictures: list[bytes] = []
        await view(CameraFeed(Camera((300, 400)), 0.2), pictures, count=1)
        assert decoded(pictures[0]).shape == (300, 400)

    run_virtual(scenario())
