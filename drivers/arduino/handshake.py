"""From the open port to a board that has identified itself."""

from __future__ import annotations

import asyncio
import secrets

from drivers.arduino.errors import BoardSilentError, WrongFirmwareError
from drivers.arduino.link.frames import Frame, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import PROTOCOL_HASH
from drivers.arduino.session import Port

BOOT_S = 3.0
"""The boot loader and the firmware's start take less; meanwhile the host is silent."""

REQUEST_PERIOD_S = 0.1
ANSWER_S = 1.0

FIRMWARE_VERSION = (0, 2, 0)
"""Of the firmware in this version's sources, firmware/core/version.hpp."""


class Handshake:
    """Finds out who is at the other end of a port.

    Args:
        port: Just opened.
    """

    def __init__(self, port: Port) -> None:
        self._port = port
        self._frames: asyncio.Queue[Frame | str] = asyncio.Queue()
        self._noise = False

    def hear(self, frame: Frame) -> None:
        """Take a frame of the board."""
        self._frames.put_nowait(frame)

    def hear_noise(self) -> None:
        """Bytes have come that are no frame of a board."""
        self._noise = True

    def lose(self, words: str) -> None:
        """The port broke."""
        self._frames.put_nowait(words)

    async def run(self) -> messages.Hello:
        """Begin a session and return how the board introduced itself.

        Raises:
            BoardSilentError: nothing answers.
            WrongFirmwareError: the board speaks another version of the protocol.
        """
        try:
            async with asyncio.timeout(BOOT_S):
                await self._next()  # whatever it says, its boot loader has ended
        except TimeoutError:
            pass  # a board that was not reset by opening the port waits for us
        session = secrets.randbelow(0xFFFF) + 1
        request = messages.HelloRequest(protocol_hash=PROTOCOL_HASH, session=session)
        hello = await self._ask(request)
        if hello.protocol_hash != PROTOCOL_HASH:
            raise WrongFirmwareError(_other_version(hello))
        return hello

    async def _ask(self, request: messages.HelloRequest) -> messages.Hello:
        for _ in range(round(ANSWER_S / REQUEST_PERIOD_S)):
            self._port.write(b"\0" + encode_frame(Frame(0, 0, request)))
            try:
                async with asyncio.timeout(REQUEST_PERIOD_S):
                    while True:
                        message = (await self._next()).message
                        if isinstance(message, messages.Hello) and (
                            message.session == request.session
                        ):
                            return message
            except TimeoutError:
                continue
        if self._noise:
            raise BoardSilentError(
                "Something answers on the port, but not as a motion board does: it is another "
                "device, has other firmware, or talks at another speed. Check robot.port and flash "
                "the firmware; see drivers/arduino/firmware/README.md."
            )
        raise BoardSilentError(
            "The port is open, but no motion board answers. Check its power and that the firmware "
            "is flashed; see drivers/arduino/firmware/README.md."
        )

    async def _next(self) -> Frame:
        item = await self._frames.get()
        if isinstance(item, str):
            raise BoardSilentError(item)
        return item


def _other_version(hello: messages.Hello) -> str:
    version = (hello.firmware_major, hello.firmware_minor, hello.firmware_patch)
    if version == FIRMWARE_VERSION:
        relation = "has the version of this program"
    else:
        older = "older" if version < FIRMWARE_VERSION else "newer"
        relation = f"is {older} than this program, which has {_dotted(FIRMWARE_VERSION)}"
    return (
        f"The board's firmware {_dotted(version)} {relation}, and speaks another version of the "
        f"protocol ({hello.protocol_hash:08X} instead of {PROTOCOL_HASH:08X}). Flash the firmware "
        "that belongs to this version; see drivers/arduino/firmware/README.md."
    )


def _dotted(version: tuple[int, int, int]) -> str:
    return ".".join(map(str, version))
