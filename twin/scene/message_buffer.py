"""What the 3D library sends to browsers, and keeps for those that join later.

viser 1.1.1 numbers every message it ever queued and keeps the newest of each kind. A browser that
joins is walked through all the numbers from 0, although all but a few hundred of them are gone:
0.1 s for a million, and a picture that was watched for a week has used up hundreds of millions.
The library's loop stands still meanwhile, for everyone. So the walk begins with the numbers that
are still there.

What comes later goes out at once, because the picture takes its steps as whole frames already; the
library would wait for more, with a timer for each browser and each frame. And it is packed once for
all browsers.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator, Sequence
from typing import TYPE_CHECKING

import viser
from viser.infra import _infra
from viser.infra._async_message_buffer import AsyncMessageBuffer
from viser.infra._messages import Message
from websockets.exceptions import ConnectionClosedError
from websockets.protocol import State

from twin.scene.frame_packer import FramePacker

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

library_producer = _infra._message_producer  # noqa: SLF001
"""What the library itself sends with."""


class LoopEvent(asyncio.Event):
    """An event that only its own loop sets.

    The library sets it from whatever thread moves a node, which asyncio's events do not allow: set
    between somebody's look at it and his wait for it, it would never wake him. Each time it also
    asks the loop to set it, and that is enough.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__()
        self._its_loop = loop

    def set(self) -> None:
        """Wakes everybody who waits; called from elsewhere than the loop it does nothing."""
        if asyncio._get_running_loop() is self._its_loop:  # noqa: SLF001 - raises nothing
            super().set()


class ReplayBuffer(AsyncMessageBuffer):
    """The library's buffer with another way to walk through it.

    Attributes:
        packer: Packs what goes out.
    """

    packer: FramePacker

    async def _window_loop(
        self,
        client_id: int,
        backlog_last_id: int,
        backlog_done_message: Message | None,
    ) -> AsyncGenerator[Sequence[Message], None]:
        """Messages for one browser, without end: first what is kept, then what comes.

        Args:
            client_id: The browser.
            backlog_last_id: Number of the last message that was there when it came.
            backlog_done_message: Sent once, after that message.
        """
        self.generator_cursors[client_id] = -1
        try:
            with self.buffer_lock:
                # They are kept in the order of their numbers.
                kept = [number for number in self.message_from_id if number <= backlog_last_id]
            for start in range(0, len(kept), self.max_window_size):
                numbers = kept[start : start + self.max_window_size]
                window = self._still_kept(numbers, client_id)
                self.generator_cursors[client_id] = numbers[-1]
                if self.done:
                    return
                if window:
                    yield window
            sent = self.generator_cursors[client_id] = backlog_last_id
            if backlog_done_message is not None:
                yield [backlog_done_message]
            while not self.done:
                # Nothing goes out while a step is put together.
                newest = self.message_counter - 1 if self.atomic_counter == 0 else sent
                if newest == sent:
                    await self.message_event.wait()
                    self.message_event.clear()
                    continue
                ahead = self._numbers(sent, newest)
                last = ahead[-1] if len(ahead) == self.max_window_size else newest
                window = self._still_kept(ahead, client_id)
                sent = self.generator_cursors[client_id] = last
                if window:
                    yield window
        finally:
            self.generator_cursors.pop(client_id, None)

    def _numbers(self, sent: int, newest: int) -> Sequence[int]:
        """The next numbers to send; of a long row, which is mostly replaced, what is kept of it."""
        if newest - sent <= self.max_window_size:
            return range(sent + 1, newest + 1)
        with self.buffer_lock:
            kept = [number for number in self.message_from_id if sent < number <= newest]
        return kept[: self.max_window_size]

    def _still_kept(self, numbers: Sequence[int], client_id: int) -> list[Message]:
        """The messages of these numbers that nothing has replaced and this browser may see."""
        messages = (self.message_from_id.get(number) for number in numbers)
        return [m for m in messages if m is not None and m.excluded_self_client != client_id]


async def send_frames(
    websocket: ServerConnection,
    buffer: AsyncMessageBuffer,
    client_id: int,
    backlog_done_message: Message | None = None,
) -> None:
    """Sends one browser what is in a buffer, until the connection or the server ends.

    Takes the place of the library's producer. What is meant for one browser alone still goes
    through that.
    """
    if not isinstance(buffer, ReplayBuffer):
        await library_producer(websocket, buffer, client_id, backlog_done_message)
        return
    windows = buffer.window_generator(client_id, backlog_done_message=backlog_done_message)
    try:
        async for window in windows:
            await _send(websocket, buffer.packer.frame(window))
    finally:
        await windows.aclose()  # lets go of the numbers that this browser still needed


async def _send(websocket: ServerConnection, frame: bytes) -> None:
    try:
        await websocket.send(frame)
    except AttributeError:
        # The library aborts a transport of a browser that has vanished, and asyncio has let go of
        # its loop by then.
        if websocket.state is not State.CLOSED:
            raise
        raise ConnectionClosedError(None, None) from None


def send_what_is_kept(server: viser.ViserServer) -> None:
    """Lets a server that nobody has joined yet send in this way.

    The buffer's class is changed in place: the library made it, and others hold it already. Servers
    that were not changed send as before.
    """
    buffer = server._websock_server._broadcast_buffer  # noqa: SLF001
    buffer.__class__ = ReplayBuffer
    buffer.message_event = LoopEvent(buffer.event_loop)
    vars(buffer)["packer"] = FramePacker()
    _infra._message_producer = send_frames  # noqa: SLF001
