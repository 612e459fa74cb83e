"""A camera driver without a camera."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from drivers.camera import CameraError, CameraModel, CameraTimeoutError, Frame
from drivers.camera.errors import CameraFrozenError, CameraMissingError, WrongResolutionError
from drivers.simulator.camera.auto_exposure import AutoExposure, ExposureSetting
from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.frame_clock import FrameClock
from drivers.simulator.camera.held_sheet import HeldSheet
from drivers.simulator.camera.imaging import CameraFault, ImagingParameters
from drivers.simulator.camera.light_history import LightHistory
from drivers.simulator.camera.renderer import Renderer, usual_light
from drivers.simulator.camera.row_motion import view_while_read_out
from drivers.simulator.view import CameraView

TIMEOUT_S = 1.0
FROZEN_FRAMES = 10
"""So many equal pictures in a row are an error, as with real cameras."""

OVEREXPOSURE = 64.0


class SimulatedCamera:
    """Exposes at a steady rate, delivers after a delay, renders only what is asked for.

    The rows of a frame are read one after the other; each sees the scene at its own time, and
    motion during the exposure blurs it. ``captured_at_s`` is the middle of the exposure of the
    middle row. Frames are reproducible: seed, number and light determine them.

    Args:
        view: Gives the true scene at an event loop time [s], up to a frame's time ago.
        optics: The true optics.
        imaging: Exposure, blur, light and noise.
        seed: Of the noise and of what became of the label.
        conditions: What label, lamps and weather are like; a flawless label if not given.

    Attributes:
        fault: What is wrong with the camera; may be set at any time.
    """

    def __init__(
        self,
        view: Callable[[float], CameraView],
        optics: CameraModel,
        imaging: ImagingParameters,
        seed: int,
        conditions: Conditions = FLAWLESS,
    ) -> None:
        self.fault = CameraFault.NONE
        self._view = view
        self._optics = optics
        self._imaging = imaging
        self._seed = seed
        self._conditions = conditions
        self._light = LightHistory()
        self._held: HeldSheet | None = None
        self._renderer: Renderer | None = None
        self._clock: FrameClock | None = None
        self._exposures: AutoExposure | None = None
        self._rendering = asyncio.Lock()
        self._newest: Frame | None = None
        self._repeated = 0

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return "Simulated camera"

    @property
    def optics(self) -> CameraModel:
        """The true optics, which a calibration should find."""
        return self._optics

    @property
    def light(self) -> float:
        """Ambient light over the configured one."""
        return self._light.newest

    def set_light(self, light: float) -> None:
        """Change the ambient light from now on; 0 is pitch dark, 1 as configured.

        Raises:
            ValueError: it is negative or not a number.
        """
        self._light.change(asyncio.get_running_loop().time(), light)

    def hold(self, sheet: HeldSheet | None) -> None:
        """From now on somebody holds this before the camera; None: nothing."""
        self._held = sheet

    async def open(self) -> None:
        """Start the frame clock.

        Raises:
            CameraMissingError: the simulated camera is unplugged.
        """
        self._require_plugged()
        self._newest = None
        if self._renderer is None:
            self._renderer = await asyncio.to_thread(
                Renderer, self._optics, self._imaging, self._seed, self._conditions
            )
        clock = FrameClock(self._imaging, asyncio.get_running_loop().time())
        self._clock = clock
        self._exposures = AutoExposure(
            self._imaging, lambda number: self._light_at(clock.read_at_s(number))
        )

    async def close(self) -> None:
        """Stop the frame clock and give the picture memory back."""
        self._clock = None
        self._newest = None
        self._renderer = None

    async def frame(self, *, exposed_after_s: float | None = None) -> Frame:
        """Wait for the next frame to be delivered.

        Args:
            exposed_after_s: Only a frame whose exposure began at or after this event loop time
                will do; None takes the next one.

        Raises:
            CameraTimeoutError: none came within a second.
            CameraFrozenError: the same picture came again and again.
            WrongResolutionError: the camera is in another mode.
            CameraMissingError: the camera is unplugged.
            CameraError: it is not open.
        """
        clock = self._require_open()
        asked_at_s = asyncio.get_running_loop().time()
        number = clock.next_number(asked_at_s, exposed_after_s)
        wait_s = clock.delivered_at_s(number) - asked_at_s
        if self.fault is CameraFault.STALLED or wait_s > TIMEOUT_S:
            await asyncio.sleep(TIMEOUT_S)
            self._require_open()
            message = f"{self.name} delivered no frame within {TIMEOUT_S:g} s: check its cable"
            raise CameraTimeoutError(message)
        await asyncio.sleep(max(wait_s, 0.0))
        if self._require_open() is not clock:
            message = f"{self.name} was opened anew while a frame was awaited: ask again"
            raise CameraError(message)
        if self.fault is CameraFault.WRONG_RESOLUTION:
            raise WrongResolutionError(
                f"{self.name} delivers {self._optics.width // 2} x {self._optics.height // 2} "
                f"pixels, but its calibration is for {self._optics.width} x "
                f"{self._optics.height}: choose that mode, or calibrate this one."
            )
        return await self._rendered(clock, number)

    async def _rendered(self, clock: FrameClock, number: int) -> Frame:
        async with self._rendering:
            newest = self._newest
            if newest is not None and newest.sequence == number:
                return newest
            setting = self._setting(number)
            captured_at_s = clock.middle_s(number, setting.exposure_s)
            if self.fault is CameraFault.FROZEN and newest is not None:
                self._require_news()
                image = newest.image
            else:
                self._repeated = 0
                view = view_while_read_out(self._view, captured_at_s, self._imaging.readout_s)
                held = self._held
                readout_s = self._imaging.readout_s
                sheet = held.while_read_out(captured_at_s, readout_s) if held else None
                image = await asyncio.to_thread(
                    self._require_renderer().picture,
                    view,
                    number,
                    setting=setting,
                    light=self._light.at(captured_at_s),
                    dark=self.fault is CameraFault.DARK,
                    sheet=sheet,
                )
                image.flags.writeable = False
            frame = Frame(image, captured_at_s, number, setting.exposure_s)
            if newest is None or newest.sequence < number:
                self._newest = frame
            return frame

    def _setting(self, number: int) -> ExposureSetting:
        if self._exposures is None:
            raise CameraError(f"{self.name} is not open: open it first")
        setting = self._exposures.at(number)
        if self.fault is CameraFault.OVEREXPOSED:
            return setting._replace(gain=setting.gain * OVEREXPOSURE)
        return setting

    def _light_at(self, t_s: float) -> float:
        return usual_light(self._imaging, self._conditions, self._light.at(t_s))

    def _require_news(self) -> None:
        """The driver of a real camera counts equal pictures and gives up at the tenth."""
        self._repeated += 1
        if self._repeated >= FROZEN_FRAMES - 1:
            raise CameraFrozenError(
                f"{self.name} has delivered the very same picture {FROZEN_FRAMES} times: unplug "
                "it and plug it in again."
            )

    def _require_plugged(self) -> None:
        if self.fault is CameraFault.UNPLUGGED:
            message = f"{self.name} is unplugged: plug it in and open it again"
            raise CameraMissingError(message)

    def _require_open(self) -> FrameClock:
        self._require_plugged()
        if self._clock is None:
            raise CameraError(f"{self.name} is not open: open it first")
        return self._clock

    def _require_renderer(self) -> Renderer:
        if self._renderer is None:  # closed while others were waiting for their picture
            raise CameraError(f"{self.name} is not open: open it first")
        return self._renderer
