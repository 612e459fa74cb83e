"""A fake board at the end of a pseudo terminal, living in a thread of its own."""

from __future__ import annotations

import contextlib
import os
import select
import threading
import time
import tty
from collections.abc import Callable, Iterator
from pathlib import Path

from drivers.arduino.protocol.messages import TICK_HZ
from tests.support.fake_board import FakeBoard

POLL_S = 0.001


class BoardCable:
    """The cable; ``device`` stays the same when it is pulled and put back.

    Args:
        folder: Where the device appears.
        protocol_hash: Handed to the board, like loss.
    """

    def __init__(self, folder: Path, **of_board: float) -> None:
        self.device = folder / "ttyBoard"
        self.board = FakeBoard(self._send, **of_board)  # type: ignore[arg-type] # a hash is an int
        self._started_s = time.monotonic()
        self._lock = threading.Lock()
        self._ending = threading.Event()
        self._host_side = self._board_side = -1
        self.plug_in()
        self._thread = threading.Thread(target=self._run, name="fake board")
        self._thread.start()

    def plug_in(self) -> None:
        """Put the cable in."""
        with self._lock:
            self._board_side, self._host_side = os.openpty()
            tty.setraw(self._host_side)
            os.set_blocking(self._board_side, False)
            self.device.unlink(missing_ok=True)
            self.device.symlink_to(os.ttyname(self._host_side))

    def pull(self) -> None:
        """Pull the cable out."""
        with self._lock:
            for side in (self._board_side, self._host_side):
                os.close(side)
            self._board_side = self._host_side = -1
            self.device.unlink()

    def change(self, action: Callable[[FakeBoard], None]) -> None:
        """Do something to the board while it is not looking."""
        with self._lock:
            action(self.board)

    def close(self) -> None:
        """End the board's life."""
        self._ending.set()
        self._thread.join()
        if self._board_side >= 0:
            self.pull()

    def _send(self, data: bytes) -> None:
        if self._board_side >= 0:
            with contextlib.suppress(OSError):  # nobody has the port open, or nobody reads
                os.write(self._board_side, data)

    def _run(self) -> None:
        while not self._ending.is_set():
            with self._lock:
                self._live()
            time.sleep(POLL_S)

    def _live(self) -> None:
        self.board.advance(int((time.monotonic() - self._started_s) * TICK_HZ))
        if self._board_side >= 0 and select.select([self._board_side], [], [], 0)[0]:
            with contextlib.suppress(OSError):
                self.board.hear(os.read(self._board_side, 4096))


@contextlib.contextmanager
def board_cable(folder: Path, **of_board: float) -> Iterator[BoardCable]:
    """A cable that is taken away afterwards."""
    cable = BoardCable(folder, **of_board)
    try:
        yield cable
    finally:
        cable.close()
