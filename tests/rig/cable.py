"""The USB cable to a board in lock step: what pyserial and the operating system are otherwise."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence

from drivers.arduino.errors import BoardNotFoundError
from drivers.arduino.link.frames import Frame, FrameReader
from drivers.arduino.protocol.messages import FROM_BOARD
from drivers.arduino.serial_port import OnFrames, OnLost
from tests.rig.control import ControlError
from tests.rig.simulator import Simulator


class CableEnd:
    """An open port: a Line without threads.

    Attributes:
        is_open: Nobody has closed it, and its device is there.
        last_write_s: When the host wrote last, in event loop time.
    """

    def __init__(self, simulator: Simulator, on_frames: OnFrames, on_lost: OnLost) -> None:
        self._simulator = simulator
        self._on_frames = on_frames
        self._on_lost = on_lost
        self._frames = FrameReader(FROM_BOARD)
        self.is_open = True
        self.last_write_s = 0.0

    def write(self, data: bytes) -> None:
        """Send bytes; into an unplugged cable they vanish."""
        if self.is_open:
            self.last_write_s = asyncio.get_running_loop().time()
            self._simulator.ask(f"write {data.hex()}")

    async def close(self) -> None:
        """Close the port. Safe to call twice."""
        if self.is_open:
            self.is_open = False
            self._simulator.ask("close")

    def receive(self, data: bytes, received_s: float) -> Sequence[Frame]:
        """Bytes have come out of the cable; the callbacks get them in the event loop."""
        frames = list(self._frames.feed(data))
        if frames:
            asyncio.get_running_loop().call_soon(self._hand_over, frames, received_s)
        return frames

    def lose(self) -> None:
        """The device has vanished."""
        self.is_open = False
        asyncio.get_running_loop().call_soon(self._on_lost, "The serial port broke: it is gone.")

    def _hand_over(self, frames: list[Frame], received_s: float) -> None:
        if self.is_open:
            self._on_frames(frames, received_s)


class Cable:
    """Opens the port of a simulated board.

    Attributes:
        end: The port that was opened last.
    """

    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator
        self.end: CableEnd | None = None

    async def open_line(self, device: str, on_frames: OnFrames, on_lost: OnLost) -> CableEnd:
        """Open the port, which resets the board; an OpenLine.

        Raises:
            BoardNotFoundError: the cable is unplugged, or the port is open already.
        """
        try:
            self._simulator.ask("open")
        except ControlError as error:
            raise BoardNotFoundError(f"The port {device} cannot be opened: {error}.") from error
        self.end = CableEnd(self._simulator, on_frames, on_lost)
        return self.end
