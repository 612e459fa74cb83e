"""Go-back-N: every sequenced message arrives exactly once and in order, or not at all.

The sender keeps a window of messages under way and sends all of them again when nothing was
acknowledged for a while. The receiver takes only the message it expects, so it needs no memory.

How long that while is follows the answers (RFC 6298): otherwise everything would be sent twice on
a slow line, and a board that has to sort that out has less time for its control loop.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from drivers.arduino.protocol.message import Message

NUMBERS = 256
"""Sequence numbers are counted modulo this."""

LONGEST_S = 0.12
"""Patience without progress grows no further: a board that is silent for longer is gone."""


@dataclass(frozen=True, slots=True)
class Numbered:
    """A message with its sequence number."""

    seq: int
    message: Message


class Patience:
    """How long to wait for an answer, from how long answers take (RFC 6298).

    Args:
        least_s: Never less than this.

    Attributes:
        timeout_s: What it is now.
    """

    def __init__(self, least_s: float) -> None:
        self.timeout_s = least_s
        self._least_s = least_s
        self._mean_s: float | None = None
        self._spread_s = 0.0

    def measure(self, took_s: float) -> None:
        """An answer took so long."""
        if self._mean_s is None:
            self._mean_s, self._spread_s = took_s, took_s / 2
        else:
            self._spread_s += (abs(self._mean_s - took_s) - self._spread_s) / 4
            self._mean_s += (took_s - self._mean_s) / 8
        self.timeout_s = min(max(self._mean_s + 4 * self._spread_s, self._least_s), LONGEST_S)

    def double(self) -> None:
        """No answer came in time: until one does, it may be the line that is slow."""
        self.timeout_s = min(2 * self.timeout_s, LONGEST_S)


class Sender:
    """The host's side.

    Messages have a ticket, counted from 0 without end; their sequence number is the ticket
    modulo 256.

    Args:
        window: Messages under way at most; less than half of the numbers.
        retransmit_s: Least patience without progress.
    """

    def __init__(self, window: int, retransmit_s: float) -> None:
        if not 0 < window < NUMBERS // 2:
            raise ValueError(f"a window of {window} messages cannot be told apart")
        self._window = window
        self._patience = Patience(retransmit_s)
        self._sent_at_s: deque[float] = deque()
        self._sent_once_from = 0
        self._messages: deque[Message] = deque()
        self._oldest = 0
        self._under_way = 0
        self._overdue_s = 0.0
        self.sent_again = 0

    @property
    def overdue_s(self) -> float | None:
        """When to call ``take_due`` again if no acknowledgement comes; None with nothing to do."""
        return self._overdue_s if self._under_way else None

    @property
    def acknowledged(self) -> int:
        """Tickets below this have been handled by the receiver."""
        return self._oldest

    def offer(self, message: Message) -> int:
        """Put a message into the queue and return its ticket."""
        self._messages.append(message)
        return self._oldest + len(self._messages) - 1

    def take_due(self, now_s: float) -> list[Numbered]:
        """What must be sent now: what the window has room for, or all of it again."""
        if self._under_way and now_s >= self._overdue_s:
            self.sent_again += self._under_way
            self._patience.double()
            # whose answer comes next, nobody can tell
            self._sent_once_from = self._oldest + self._under_way
            self._under_way = 0
            self._sent_at_s.clear()
        first = self._under_way
        self._under_way = min(len(self._messages), self._window)
        if self._under_way > first:
            self._overdue_s = now_s + self._patience.timeout_s
            self._sent_at_s.extend([now_s] * (self._under_way - first))
        return [
            Numbered((self._oldest + index) % NUMBERS, self._messages[index])
            for index in range(first, self._under_way)
        ]

    def acknowledge(self, ack: int, now_s: float) -> range:
        """Take note of the number the receiver expects; return the tickets it has newly handled.

        A number that cannot follow from what is under way is old and changes nothing.
        """
        count = (ack - self._oldest) % NUMBERS
        if not 0 < count <= self._under_way:
            return range(0)
        first = self._oldest
        for ticket in range(first, first + count):
            self._messages.popleft()
            sent_at_s = self._sent_at_s.popleft()
            if ticket >= self._sent_once_from:
                self._patience.measure(now_s - sent_at_s)
        self._oldest += count
        self._under_way = max(self._under_way - count, 0)
        self._overdue_s = now_s + self._patience.timeout_s
        return range(first, self._oldest)


class Receiver:
    """The board's side, as the firmware does it."""

    def __init__(self) -> None:
        self.expected = 0

    def accept(self, seq: int) -> bool:
        """Whether a message is the expected one; then the next is expected."""
        if seq != self.expected:
            return False
        self.expected = (self.expected + 1) % NUMBERS
        return True
