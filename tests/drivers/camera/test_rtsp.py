"""A network camera that speaks RTSP, on a real socket."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator

import pytest

from drivers.camera import CameraError, CameraTimeoutError, grabbing, stream
from drivers.camera.errors import CameraFrozenError, CameraMissingError
from drivers.camera.grabbing import GrabbingCamera
from drivers.camera.settings import StreamSettings
from drivers.camera.stream import StreamSource
from tests.support.eventually import eventually
from tests.support.rtsp_camera import FRAMES_PER_S, SHAPE, RtspCamera, number_of, rtsp_camera

LATENCY_S = 0.05


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(grabbing, "REOPEN_S", 0.05)


def source(camera: RtspCamera) -> StreamSource:
    settings = StreamSettings(url=camera.url, frames_per_s=FRAMES_PER_S, latency_s=LATENCY_S)
    return StreamSource(settings)


@contextlib.asynccontextmanager
async def watched() -> AsyncIterator[tuple[RtspCamera, GrabbingCamera]]:
    async with rtsp_camera() as camera:
        driver = GrabbingCamera(source(camera), None)
        try:
            await driver.open()
            yield camera, driver
        finally:
            await driver.close()


async def failure_of(driver: GrabbingCamera, kind: type[CameraError]) -> None:
    """Returns when asking for a frame ends with an error of a kind."""

    async def failed() -> bool:
        try:
            await driver.frame()
        except CameraError as error:
            return isinstance(error, kind)
        return False

    await eventually(failed)


async def success_of(driver: GrabbingCamera) -> int:
    """Number of the first picture that comes."""
    async with asyncio.timeout(10):
        while True:
            with contextlib.suppress(CameraError):
                return number_of((await driver.frame()).image)
            await asyncio.sleep(0.02)


async def test_the_first_picture_is_none_that_waited_for_the_connection() -> None:
    async with watched() as (camera, driver):
        sent = camera.newest
        assert sent > 5, "FFmpeg takes some pictures to find out what the stream holds"
        frame = await driver.frame()
        assert frame.image.shape == SHAPE
        assert number_of(frame.image) >= sent
        age_s = asyncio.get_running_loop().time() - frame.captured_at_s
        assert LATENCY_S <= age_s < LATENCY_S + 0.5
        assert camera.asked[:4] == ["OPTIONS", "DESCRIBE", "SETUP", "PLAY"]


async def test_whoever_asks_late_gets_the_newest() -> None:
    async with watched() as (camera, driver):
        first = await driver.frame()
        await eventually(lambda: camera.newest > number_of(first.image) + 30)
        sent = camera.newest
        later = await driver.frame()
        assert number_of(later.image) >= sent
        passed = number_of(later.image) - number_of(first.image)
        assert abs(later.sequence - first.sequence - passed) <= 2, "skipped pictures are counted"


async def test_pictures_that_were_held_up_are_not_taken_for_new_ones() -> None:
    async with watched() as (camera, driver):
        began_s = (await driver.frame()).captured_at_s
        camera.held_up = True
        sent = camera.newest
        await eventually(lambda: camera.newest > sent + 15)
        held = camera.newest
        now_s = asyncio.get_running_loop().time()
        asked = asyncio.create_task(driver.frame(exposed_after_s=now_s - LATENCY_S))
        await asyncio.sleep(0)
        camera.held_up = False
        frame = await asked
        assert number_of(frame.image) >= held
        assert frame.captured_at_s > began_s


async def test_a_camera_that_is_switched_off_is_missed_and_found_again() -> None:
    async with watched() as (camera, driver):
        await driver.frame()
        await camera.switch_off()
        await failure_of(driver, CameraMissingError)
        sent = camera.newest
        await camera.switch_on()
        assert await success_of(driver) > sent


async def test_a_camera_that_sends_one_picture_for_ever_is_frozen_until_it_thaws() -> None:
    async with watched() as (camera, driver):
        await driver.frame()
        camera.frozen = True
        await failure_of(driver, CameraFrozenError)
        camera.frozen = False
        assert await success_of(driver) >= camera.newest - 2


async def test_a_camera_that_falls_silent_is_called_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(grabbing, "TIMEOUT_S", 0.2)
    monkeypatch.setattr(stream, "READ_TIMEOUT_MS", 500)
    monkeypatch.setattr(stream, "OPEN_TIMEOUT_MS", 1000)
    async with watched() as (camera, driver):
        await driver.frame()
        camera.silent = True
        await failure_of(driver, CameraTimeoutError)
        await failure_of(driver, CameraMissingError)
        calls = camera.asked.count("DESCRIBE")
        camera.silent = False
        await success_of(driver)
        assert camera.asked.count("DESCRIBE") >= max(calls, 2)


async def test_a_camera_is_left_politely() -> None:
    async with watched() as (camera, driver):
        await driver.frame()
        await driver.close()
        await eventually(lambda: camera.asked[-1] == "TEARDOWN")


async def test_nobody_there() -> None:
    async with rtsp_camera() as camera:
        await camera.switch_off()
        nobody = source(camera)
        with pytest.raises(CameraMissingError, match=r"127\.0\.0\.1 does not answer"):
            await asyncio.to_thread(nobody.open)
        nobody.close()
