"""What passes between the server's drivers and the garage: pickled messages over a Unix socket.

Both ends are this very code on this very machine.
"""

from __future__ import annotations

import pickle
import socket
import struct
from dataclasses import dataclass
from typing import Any

TICK_S = 0.005
"""The garage goes on by this, in simulated time; commands and samples wait for it."""

_LENGTH = struct.Struct("!I")


@dataclass(frozen=True, slots=True)
class Call:
    """A call of one driver's method.

    Attributes:
        number: The answer has the same one.
        device: "robot", "camera" or "station".
        method: Of the driver.
        arguments: Of the method, by name.
    """

    number: int
    device: str
    method: str
    arguments: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Tick:
    """From the server: it is this time, and these calls are made.

    Attributes:
        now_s: Event loop time of the server.
        calls: Since the last tick.
    """

    now_s: float
    calls: list[Call]


@dataclass(frozen=True, slots=True)
class Answer:
    """What came of a call.

    Attributes:
        number: Of the call.
        value: What it has returned, if it has.
        error: What it has raised, as its type and what that is made of; None if nothing.
    """

    number: int
    value: object
    error: tuple[type[Exception], tuple[str, ...]] | None


@dataclass(frozen=True, slots=True)
class Tock:
    """From the garage: it has come as far, and this is what has happened.

    Attributes:
        samples: Of the motion board, times on the clock of the server.
        answers: To calls of this and earlier ticks.
    """

    samples: list[Any]
    answers: list[Answer]


def send(line: socket.socket, message: object) -> None:
    """Write a message.

    Raises:
        OSError: the other end is gone.
    """
    packed = pickle.dumps(message, protocol=pickle.HIGHEST_PROTOCOL)
    line.sendall(_LENGTH.pack(len(packed)) + packed)


def receive(line: socket.socket) -> Any:  # noqa: ANN401 - any message
    """Read a message; blocks.

    Raises:
        EOFError: the other end is gone.
    """
    (length,) = _LENGTH.unpack(_read(line, _LENGTH.size))
    return pickle.loads(_read(line, length))  # noqa: S301 - our own process wrote it


def _read(line: socket.socket, count: int) -> bytes:
    parts = bytearray()
    while len(parts) < count:
        try:
            part = line.recv(count - len(parts))
        except ConnectionError:
            part = b""
        if not part:
            raise EOFError
        parts += part
    return bytes(parts)
