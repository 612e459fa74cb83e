"""A serial port with a thread for each direction, so that the event loop never waits for bytes."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Callable
from functools import partial
from queue import SimpleQueue
from typing import Protocol

import serial

from drivers.arduino.errors import BoardNotFoundError
from drivers.arduino.link.frames import Frame, FrameReader
from drivers.arduino.protocol.messages import BAUD, FROM_BOARD

READ_TIMEOUT_S = 0.1
"""How long the reader waits before it looks whether it shall end."""

WRITE_TIMEOUT_S = 1.0
"""A port that takes nothing for so long is broken."""

OnFrames = Callable[[list[Frame], float], None]
OnLost = Callable[[str], None]


class Line(Protocol):
    """An open line to a board."""

    def write(self, data: bytes) -> None:
        """Send bytes; returns at once."""
        ...

    async def close(self) -> None:
        """Send what is queued and close the line. Safe to call twice."""
        ...


class OpenLine(Protocol):
    """Opens lines. That may reset the board."""

    async def __call__(self, device: str, on_frames: OnFrames, on_lost: OnLost) -> Line:
        """Open the line at a device.

        Args:
            device: As the configuration names it.
            on_frames: Gets intact frames and when their last byte came, in event loop time. Until
                the first one it also hears of other bytes: then there are no frames.
            on_lost: Gets a sentence when the line breaks; called at most once.

        Raises:
            BoardNotFoundError: it cannot be opened.
        """
        ...


class SerialPort:
    """An open serial port: a Line. The callbacks run in the event loop.

    Args:
        line: The open port.
        loop: Where the callbacks run.
        on_frames: Gets intact frames and when their last byte came, in event loop time.
        on_lost: Gets a sentence when the port breaks; called at most once.
    """

    def __init__(
        self,
        line: serial.Serial,
        loop: asyncio.AbstractEventLoop,
        on_frames: OnFrames,
        on_lost: OnLost,
    ) -> None:
        self._line = line
        self._loop = loop
        self._on_frames = on_frames
        self._on_lost = on_lost
        self._closing = threading.Event()
        self._frames = FrameReader(FROM_BOARD)
        self._out: SimpleQueue[bytes | None] = SimpleQueue()
        self._reader = threading.Thread(target=self._read, name="board reader", daemon=True)
        self._writer = threading.Thread(target=self._write, name="board writer", daemon=True)
        self._reader.start()
        self._writer.start()

    @property
    def damaged(self) -> int:
        """Frames that arrived damaged since the port was opened."""
        return self._frames.damaged

    def write(self, data: bytes) -> None:
        """Send bytes; returns at once."""
        self._out.put(data)

    async def close(self) -> None:
        """Send what is queued and close the port. Safe to call twice."""
        self._closing.set()
        self._out.put(None)
        await asyncio.to_thread(self._end)

    def _end(self) -> None:
        self._writer.join()
        self._reader.join()
        self._line.close()

    def _read(self) -> None:
        frames = self._frames
        understood = False
        while not self._closing.is_set():
            try:
                data = self._line.read(max(1, self._line.in_waiting))
            except OSError as error:
                self._break(error)
                return
            received_s = self._loop.time()
            found = list(frames.feed(data))
            if found or (data and not understood):
                understood = understood or bool(found)
                self._call(partial(self._on_frames, found, received_s))

    def _write(self) -> None:
        while (data := self._out.get()) is not None:
            try:
                self._line.write(data)
            except OSError as error:
                self._break(error)
                return

    def _break(self, error: OSError) -> None:
        if not self._closing.is_set():
            self._closing.set()
            self._out.put(None)
            self._call(partial(self._on_lost, f"The serial port broke: {error}"))

    def _call(self, callback: Callable[[], None]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended before the port
            self._loop.call_soon_threadsafe(callback)


async def open_serial(device: str, on_frames: OnFrames, on_lost: OnLost) -> SerialPort:
    """Open a port. That may reset the board.

    Raises:
        BoardNotFoundError: it cannot be opened.
    """
    try:
        line = await asyncio.to_thread(
            serial.Serial,
            device,
            BAUD,
            timeout=READ_TIMEOUT_S,
            write_timeout=WRITE_TIMEOUT_S,
            exclusive=True,
        )
    except (OSError, ValueError) as error:
        raise BoardNotFoundError(
            f"The port {device} cannot be opened: {error}. Check the cable, who else uses the "
            "port, and that this user may use serial ports."
        ) from error
    return SerialPort(line, asyncio.get_running_loop(), on_frames, on_lost)
