"""The camera driver: what it delivers when."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

import numpy as np
import pytest

from drivers.camera import CameraDriver, CameraError, CameraModel, CameraTimeoutError
from drivers.camera.errors import CameraFrozenError, CameraMissingError, WrongResolutionError
from drivers.simulator.camera.camera import SimulatedCamera
from drivers.simulator.camera.imaging import CameraFault, ImagingParameters
from drivers.simulator.view import CameraView
from server.timing import VirtualTimeLoop

OPTICS = CameraModel(width=320, height=240, fx=265.0, fy=265.0, cx=159.5, cy=119.5)
IMAGING = ImagingParameters(frames_per_s=25.0, exposure_s=0.008, readout_s=0.02, latency_s=0.025)


class Garage:
    """A label that drifts sideways; remembers which instants were looked at."""

    def __init__(self) -> None:
        self.asked_at_s: list[float] = []

    def view(self, at_s: float) -> CameraView:
        self.asked_at_s.append(at_s)
        label = np.eye(4)
        label[:3, 3] = 20.0 * at_s - 20.0, 0.0, 250.0
        socket = label.copy()
        socket[0, 3] += 120.0
        plug = np.eye(4)
        plug[:3, 3] = 300.0, 0.0, 100.0
        return CameraView(label, socket, plug, np.array([20.0, 0.0, 0.0]), "label", 60.0)


def camera(garage: Garage | None = None, seed: int = 1) -> SimulatedCamera:
    return SimulatedCamera((garage or Garage()).view, OPTICS, IMAGING, seed)


def run(scenario: Callable[[], Coroutine[Any, Any, None]]) -> None:
    """Run a scenario in virtual time."""
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(scenario())


def now_s() -> float:
    return asyncio.get_running_loop().time()


def test_it_is_a_camera_driver() -> None:
    driver: CameraDriver = camera()
    assert driver.name


def test_the_middle_row_sees_the_time_of_the_frame_which_arrives_after_the_latency() -> None:
    async def scenario() -> None:
        garage = Garage()
        driver = camera(garage)
        await asyncio.sleep(3.0)
        await driver.open()
        frame = await driver.frame()
        assert frame.sequence == 0
        assert frame.captured_at_s == pytest.approx(3.014)
        assert now_s() == pytest.approx(3.053)
        # the middle row, the first and the last: 20 ms of read-out lie between these
        assert garage.asked_at_s == pytest.approx([3.014, 3.004, 3.024])
        assert frame.image.shape == (240, 320)
        assert frame.image.dtype == np.uint8
        assert not frame.image.flags.writeable

    run(scenario)


def test_only_frames_that_are_asked_for_are_rendered_and_the_gaps_are_counted() -> None:
    async def scenario() -> None:
        garage = Garage()
        driver = camera(garage)
        await driver.open()
        first = await driver.frame()
        await asyncio.sleep(1.0)
        second = await driver.frame()
        assert len(garage.asked_at_s) == 2 * 3
        assert second.sequence - first.sequence == 26
        assert second.captured_at_s - first.captured_at_s == pytest.approx(26 / 25)

    run(scenario)


@pytest.mark.parametrize("delay_s", [0.0, 0.013, 0.039, 0.04, 0.0401])
def test_the_exposure_begins_after_the_instant_that_was_asked_for(delay_s: float) -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        await asyncio.sleep(1.0 + delay_s)
        asked_at_s = now_s()
        frame = await driver.frame(exposed_after_s=asked_at_s)
        began_at_s = frame.captured_at_s - 0.004 - 0.010
        assert asked_at_s - 1e-6 <= began_at_s < asked_at_s + 0.04 + 1e-6
        assert now_s() == pytest.approx(began_at_s + 0.053)

    run(scenario)


def test_a_demand_of_long_ago_gives_the_next_frame_not_an_old_one() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        await asyncio.sleep(2.0)
        frame = await driver.frame(exposed_after_s=0.5)
        assert now_s() - frame.captured_at_s < 0.053 + 0.04

    run(scenario)


def test_frames_one_after_the_other_are_different_frames() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        numbers = [(await driver.frame()).sequence for _ in range(5)]
        assert numbers == sorted(set(numbers))

    run(scenario)


def test_two_who_wait_for_the_same_frame_get_the_same() -> None:
    async def scenario() -> None:
        garage = Garage()
        driver = camera(garage)
        await driver.open()
        one, other = await asyncio.gather(driver.frame(), driver.frame())
        assert one is other
        assert len(garage.asked_at_s) == 3

    run(scenario)


def test_the_same_seed_gives_the_same_pictures_whichever_are_looked_at() -> None:
    async def third_frame(driver: SimulatedCamera, *, look_at_all: bool) -> bytes:
        await driver.open()
        opened_at_s = now_s()
        if look_at_all:
            await driver.frame()
            await driver.frame()
        frame = await driver.frame(exposed_after_s=opened_at_s + 0.08)
        assert frame.sequence == 2
        return frame.image.tobytes()

    async def alone(seed: int, *, look_at_all: bool) -> bytes:
        return await third_frame(camera(seed=seed), look_at_all=look_at_all)

    pictures = []
    for seed, look_at_all in ((1, False), (1, True), (2, False)):
        with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
            pictures.append(runner.run(alone(seed, look_at_all=look_at_all)))
    assert pictures[0] == pictures[1]
    assert pictures[0] != pictures[2]


def test_a_frame_too_far_in_the_future_times_out() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        with pytest.raises(CameraTimeoutError):
            await driver.frame(exposed_after_s=now_s() + 5.0)
        assert now_s() == pytest.approx(1.0)

    run(scenario)


def test_a_stalled_camera_times_out_after_a_second() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        driver.fault = CameraFault.STALLED
        with pytest.raises(CameraTimeoutError, match="cable"):
            await driver.frame()
        assert now_s() == pytest.approx(1.0)
        driver.fault = CameraFault.NONE
        assert (await driver.frame()).sequence > 20

    run(scenario)


def test_an_unplugged_camera_is_an_error_at_once_and_also_while_waiting() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        waiting = asyncio.ensure_future(driver.frame())
        await asyncio.sleep(0.01)
        driver.fault = CameraFault.UNPLUGGED
        with pytest.raises(CameraMissingError, match="unplugged"):
            await waiting
        with pytest.raises(CameraMissingError, match="unplugged"):
            await driver.frame()
        await driver.close()
        with pytest.raises(CameraMissingError, match="unplugged"):
            await driver.open()

    run(scenario)


def test_a_frozen_camera_repeats_its_picture_under_new_numbers() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        alive = await driver.frame()
        driver.fault = CameraFault.FROZEN
        frozen = await driver.frame()
        assert frozen.sequence > alive.sequence
        assert frozen.captured_at_s > alive.captured_at_s
        assert frozen.image is alive.image
        driver.fault = CameraFault.NONE
        assert np.any((await driver.frame()).image != alive.image)

    run(scenario)


def test_the_tenth_equal_picture_is_an_error_until_the_picture_moves_again() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        await driver.frame()
        driver.fault = CameraFault.FROZEN
        for _ in range(8):
            await driver.frame()
        for _ in range(3):
            with pytest.raises(CameraFrozenError, match="same picture 10 times"):
                await driver.frame()
        driver.fault = CameraFault.NONE
        await driver.frame()
        driver.fault = CameraFault.FROZEN
        await driver.frame()

    run(scenario)


def test_another_mode_of_the_camera_is_told_by_its_resolution() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        driver.fault = CameraFault.WRONG_RESOLUTION
        with pytest.raises(WrongResolutionError, match=r"160 x 120 .* 320 x 240"):
            await driver.frame()
        driver.fault = CameraFault.NONE
        assert (await driver.frame()).image.shape == (240, 320)

    run(scenario)


def test_far_too_much_light_leaves_hardly_anything_but_white() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        driver.fault = CameraFault.OVEREXPOSED
        assert np.mean((await driver.frame()).image == 255) > 0.9

    run(scenario)


def test_a_lamp_that_is_switched_off_darkens_frames_exposed_later() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        await asyncio.sleep(0.1)
        waiting = asyncio.ensure_future(driver.frame())  # its rows were read before the change
        await asyncio.sleep(0)
        driver.set_light(0.1)
        lit, dim = await waiting, await driver.frame(exposed_after_s=now_s())
        assert dim.image.mean() < 0.6 * lit.image.mean()
        with pytest.raises(ValueError, match="light"):
            driver.set_light(float("nan"))

    run(scenario)


def test_without_light_there_is_only_noise() -> None:
    async def scenario() -> None:
        driver = camera()
        await driver.open()
        bright = await driver.frame()
        driver.fault = CameraFault.DARK
        dark = await driver.frame()
        assert np.percentile(bright.image, 90) > 120
        assert dark.image.mean() < 60
        assert dark.image.std() > 1
        correlation = np.corrcoef(dark.image.ravel(), bright.image.ravel())[0, 1]
        assert abs(correlation) < 0.05

    run(scenario)


def test_a_camera_that_is_not_open_says_so() -> None:
    async def scenario() -> None:
        driver = camera()
        with pytest.raises(CameraError, match="open it first"):
            await driver.frame()
        await driver.open()
        waiting = asyncio.ensure_future(driver.frame())
        await asyncio.sleep(0.01)
        await driver.close()
        await driver.close()
        with pytest.raises(CameraError, match="open it first"):
            await waiting

    run(scenario)
