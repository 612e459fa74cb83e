"""A camera driver without a camera."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable

from drivers.camera import CameraError, CameraModel, CameraTimeoutError, Frame
from drivers.simulator.camera.imaging import CameraFault, ImagingParameters
from drivers.simulator.camera.renderer import Renderer
from drivers.simulator.view import CameraView

TIMEOUT_S = 1.0
_ROUNDING_S = 1e-9


class SimulatedCamera:
    """Exposes at a steady rate, delivers after a delay, renders only what is asked for.

    Frame n is exposed from opening + n / rate on, for the exposure time, and delivered latency_s
    after its exposure ended. The view is taken in the middle of the exposure; motion during the
    exposure blurs the picture. Frames are reproducible: seed and number determine the noise.

    Args:
        view: Gives the true scene at an event loop time [s], up to exposure and latency ago.
        optics: The true optics.
        imaging: Exposure, blur, light and noise.
        seed: Of the noise.

    Attributes:
        fault: What is wrong with the camera; may be set at any time.
    """

    def __init__(
        self,
        view: Callable[[float], CameraView],
        optics: CameraModel,
        imaging: ImagingParameters,
        seed: int,
    ) -> None:
        self.fault = CameraFault.NONE
        self._view = view
        self._optics = optics
        self._imaging = imaging
        self._seed = seed
        self._renderer: Renderer | None = None
        self._opened_at_s: float | None = None
        self._rendering = asyncio.Lock()
        self._newest: Frame | None = None

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return "Simulated camera"

    @property
    def optics(self) -> CameraModel:
        """The true optics, which a calibration should find."""
        return self._optics

    async def open(self) -> None:
        """Start the frame clock.

        Raises:
            CameraError: the simulated camera is unplugged.
        """
        self._require_plugged()
        self._newest = None
        if self._renderer is None:
            self._renderer = await asyncio.to_thread(
                Renderer, self._optics, self._imaging, self._seed
            )
        self._opened_at_s = asyncio.get_running_loop().time()

    async def close(self) -> None:
        """Stop the frame clock and give the picture memory back."""
        self._opened_at_s = None
        self._newest = None
        self._renderer = None

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        """Wait for the next frame to be delivered.

        Args:
            exposed_after_s: Only a frame whose exposure began at or after this event loop time
                will do; None takes the next one.

        Raises:
            CameraTimeoutError: none came within a second.
            CameraError: the camera is unplugged or not open.
        """
        opened_at_s = self._require_open()
        loop = asyncio.get_running_loop()
        asked_at_s = loop.time()
        number = self._next_number(opened_at_s, asked_at_s, exposed_after_s)
        wait_s = self._delivered_at_s(opened_at_s, number) - asked_at_s
        if self.fault is CameraFault.STALLED or wait_s > TIMEOUT_S:
            await asyncio.sleep(TIMEOUT_S)
            self._require_open()
            message = f"{self.name} delivered no frame within {TIMEOUT_S:g} s: check its cable"
            raise CameraTimeoutError(message)
        await asyncio.sleep(max(wait_s, 0.0))
        if self._require_open() != opened_at_s:
            message = f"{self.name} was opened anew while a frame was awaited: ask again"
            raise CameraError(message)
        return await self._rendered(opened_at_s, number)

    async def _rendered(self, opened_at_s: float, number: int) -> Frame:
        async with self._rendering:
            newest = self._newest
            if newest is not None and newest.sequence == number:
                return newest
            imaging = self._imaging
            captured_at_s = opened_at_s + number / imaging.frames_per_s + imaging.exposure_s / 2
            if self.fault is CameraFault.FROZEN and newest is not None:
                image = newest.image
            else:
                dark = self.fault is CameraFault.DARK
                view = self._view(captured_at_s)
                renderer = self._require_renderer()
                image = await asyncio.to_thread(renderer.picture, view, number, dark=dark)
                image.flags.writeable = False
            frame = Frame(image, captured_at_s, number)
            if newest is None or newest.sequence < number:
                self._newest = frame
            return frame

    def _next_number(self, opened_at_s: float, now_s: float, exposed_after_s: float | None) -> int:
        """Number of the next frame to be delivered whose exposure began late enough."""
        imaging = self._imaging
        delivered_s = now_s - imaging.exposure_s - imaging.latency_s - opened_at_s + _ROUNDING_S
        number = max(math.floor(delivered_s * imaging.frames_per_s) + 1, 0)
        if exposed_after_s is None:
            return number
        began_s = exposed_after_s - opened_at_s - _ROUNDING_S
        return max(number, math.ceil(began_s * imaging.frames_per_s))

    def _delivered_at_s(self, opened_at_s: float, number: int) -> float:
        imaging = self._imaging
        return opened_at_s + number / imaging.frames_per_s + imaging.exposure_s + imaging.latency_s

    def _require_plugged(self) -> None:
        if self.fault is CameraFault.UNPLUGGED:
            message = f"{self.name} is unplugged: plug it in and open it again"
            raise CameraError(message)

    def _require_open(self) -> float:
        self._require_plugged()
        if self._opened_at_s is None:
            raise CameraError(f"{self.name} is not open: open it first")
        return self._opened_at_s

    def _require_renderer(self) -> Renderer:
        if self._renderer is None:  # closed while others were waiting for their picture
            raise CameraError(f"{self.name} is not open: open it first")
        return self._renderer
