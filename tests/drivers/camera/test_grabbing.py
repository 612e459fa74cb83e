"""The thread behind real cameras, led by a source that does as the test says."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator

import pytest

from drivers.camera import CameraError, CameraModel, CameraTimeoutError, Frame, grabbing
from drivers.camera.errors import CameraFrozenError, CameraMissingError, WrongResolutionError
from drivers.camera.grabbing import GrabbingCamera
from tests.drivers.camera.sources import SHAPE, LedSource, picture
from tests.support.eventually import eventually

PATIENCE_S = 30.0
OPTICS = CameraModel(width=SHAPE[1], height=SHAPE[0], fx=50, fy=50, cx=32, cy=24)


@pytest.fixture(autouse=True)
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A thread may get no turn for a second on a machine that is busy with other tests."""
    monkeypatch.setattr(grabbing, "TIMEOUT_S", PATIENCE_S)


@contextlib.asynccontextmanager
async def grabbed(
    source: LedSource, optics: CameraModel | None = OPTICS
) -> AsyncIterator[GrabbingCamera]:
    camera = GrabbingCamera(source, optics)
    try:
        yield camera
    finally:
        closing = asyncio.create_task(camera.close())
        await asyncio.sleep(0)
        source.hand(picture(0))  # lets the thread go
        await closing


async def awaited(camera: GrabbingCamera, source: LedSource, *frames: object) -> Frame:
    """Ask, and hand pictures over once the camera knows that somebody waits."""
    asked = asyncio.create_task(camera.frame())
    await asyncio.sleep(0)
    source.hand(picture(250))  # the thread may be in the middle of skipping this one
    for frame in frames:
        source.hand(frame)  # type: ignore[arg-type]
    return await asked


async def test_a_picture_taken_after_the_question_is_given() -> None:
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        frame = await awaited(camera, source, picture(7, age_s=0.2, exposure_s=0.01))
        assert frame.image.shape == SHAPE
        assert not frame.image.flags.writeable


async def test_the_time_of_a_picture_is_its_own_and_not_of_its_arrival() -> None:
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        loop = asyncio.get_running_loop()
        asked_s = loop.time()
        asked = asyncio.create_task(camera.frame(exposed_after_s=asked_s - 300))
        await asyncio.sleep(0)
        source.hand(picture(1, age_s=500))
        source.hand(picture(2, age_s=500))
        source.hand(picture(3, age_s=250, exposure_s=200))  # began too early, too
        source.hand(picture(4, age_s=100))
        frame = await asked
        assert frame.image[0, 0] == 4
        assert frame.captured_at_s == pytest.approx(asked_s - 100, abs=PATIENCE_S)


async def test_pictures_that_nobody_waits_for_are_not_decoded() -> None:
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        for number in range(5):
            source.hand(picture(number))
        await eventually(lambda: source.skipped == 5)
        frame = await awaited(camera, source, picture(99))
        assert frame.sequence >= 5


async def test_lost_pictures_are_counted() -> None:
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        first = await awaited(camera, source, picture(1))
        source.hand(picture(2, lost=3))
        await eventually(lambda: camera.dropped == 3)  # and with it all that came before
        second = await awaited(camera, source, picture(3, lost=2))
        await eventually(lambda: camera.dropped == 5)
        assert second.sequence > first.sequence + 3


async def test_a_camera_that_is_not_there_says_so_and_is_found_later(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(grabbing, "REOPEN_S", 0.01)
    source = LedSource()
    source.refuse = CameraMissingError("no such camera")
    async with grabbed(source) as camera:
        with pytest.raises(CameraMissingError, match="no such camera"):
            await camera.open()
        with pytest.raises(CameraMissingError):
            await camera.frame()
        source.refuse = None
        before = source.opened
        await eventually(lambda: source.opened > before)
        source.hand(picture(1))
        await eventually(lambda: _delivers(camera, source))


async def test_an_unplugged_camera_fails_those_who_wait_and_comes_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(grabbing, "REOPEN_S", 0.01)
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        asked = asyncio.create_task(camera.frame())
        await asyncio.sleep(0)
        source.hand(CameraMissingError("pulled out"))
        with pytest.raises(CameraMissingError, match="pulled out"):
            await asked
        await eventually(lambda: _delivers(camera, source))
        assert source.opened >= 2
        assert source.closed >= 1


async def test_an_error_of_the_library_is_one_of_the_camera(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(grabbing, "REOPEN_S", 0.01)
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        asked = asyncio.create_task(camera.frame())
        await asyncio.sleep(0)
        source.hand(RuntimeError("select() timeout"))
        with pytest.raises(CameraError, match=r"Test camera has failed: select\(\) timeout"):
            await asked


async def test_a_frozen_camera_is_noticed_and_forgiven_when_it_thaws() -> None:
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        await awaited(camera, source, picture(250))
        with pytest.raises(CameraFrozenError, match="the very same picture 10 times"):
            await _ask_until_refused(camera, source)
        source.hand(picture(3))
        await eventually(lambda: _delivers(camera, source))


async def test_pictures_of_another_size_are_refused() -> None:
    source = LedSource()
    other = OPTICS.model_copy(update={"width": 1640, "height": 1232})
    async with grabbed(source, other) as camera:
        await camera.open()
        with pytest.raises(WrongResolutionError, match=r"64 x 48 pixels.*for 1640 x 1232"):
            await awaited(camera, source, picture(1))


async def test_silence_is_a_timeout(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(grabbing, "TIMEOUT_S", 0.05)
    source = LedSource()
    async with grabbed(source) as camera:
        await camera.open()
        with pytest.raises(CameraTimeoutError, match="check its cable"):
            await camera.frame()


async def test_a_closed_camera_gives_nothing() -> None:
    source = LedSource()
    camera = GrabbingCamera(source, OPTICS)
    with pytest.raises(CameraError, match="not open"):
        await camera.frame()
    await camera.close()
    assert source.opened == 0


async def _ask_until_refused(camera: GrabbingCamera, source: LedSource) -> None:
    async with asyncio.timeout(10):
        while True:
            asked = asyncio.create_task(camera.frame())
            while not asked.done():
                source.hand(picture(250))
                await asyncio.sleep(0.002)
            await asked


_changing = iter(range(10**9))


async def _delivers(camera: GrabbingCamera, source: LedSource) -> bool:
    asked = asyncio.create_task(camera.frame())
    await asyncio.sleep(0)
    source.hand(picture(next(_changing) % 100))
    source.hand(picture(next(_changing) % 100 + 100))
    try:
        await asked
    except CameraError:
        return False
    return True
