"""What the 3D library keeps for browsers that join later, read without counting from zero.

viser 1.1.1 numbers every message it ever queued and keeps the newest of each kind. A browser that
joins is walked through all the numbers from 0, although all but a few hundred of them are gone:
0.1 s for a million, and a picture that was watched for a week has used up hundreds of millions.
The library's loop stands still meanwhile, for everyone. So the walk begins with the numbers that
are still there.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncGenerator, Sequence

import viser
from viser.infra._async_message_buffer import AsyncMessageBuffer
from viser.infra._messages import Message

_LOOK_AGAIN_S = 0.1


class ReplayBuffer(AsyncMessageBuffer):
    """The library's buffer with another way to walk through it."""

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
        flush = self.event_loop.create_task(self.flush_event.wait())
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
                last = self.message_counter - 1 if self.atomic_counter == 0 else sent
                last = min(last, sent + self.max_window_size)
                window = self._still_kept(range(sent + 1, last + 1), client_id)
                sent = self.generator_cursors[client_id] = last
                if window:
                    yield window
                else:
                    await self._something_new()
                if not window or sent == self.message_counter - 1:
                    done, _ = await asyncio.wait([flush], timeout=self.window_duration_sec)
                    if flush in done and not self.done:
                        self.flush_event.clear()
                        flush = self.event_loop.create_task(self.flush_event.wait())
        finally:
            self.generator_cursors.pop(client_id, None)
            flush.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await flush

    async def _something_new(self) -> None:
        """Waits for a message, or a moment.

        The library sets this event from other threads too, which asyncio's events do not allow:
        set between the look at it and the wait for it, it never wakes anybody again.
        """
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(_LOOK_AGAIN_S):
                await self.message_event.wait()
        self.message_event.clear()

    def _still_kept(self, numbers: Sequence[int], client_id: int) -> list[Message]:
        """The messages of these numbers that nothing has replaced and this browser may see."""
        messages = (self.message_from_id.get(number) for number in numbers)
        return [m for m in messages if m is not None and m.excluded_self_client != client_id]


def replay_what_is_kept(server: viser.ViserServer) -> None:
    """Lets a server that nobody has joined yet use the other walk.

    The buffer's class is changed in place: the library made it, and others hold it already.
    """
    buffer = server._websock_server._broadcast_buffer  # noqa: SLF001
    buffer.__class__ = ReplayBuffer
