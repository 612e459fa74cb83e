"""The two kinds of ports on the command line: TCP ports have numbers, serial ports have names."""

from __future__ import annotations

import re
from collections.abc import Sequence

from server.config import ConfigurationError, Option, Settings

PORT = "--port"
SERIAL = "--serial"

_NUMBER = re.compile(r"[+-]?\d+")


class PortOptionsError(ConfigurationError):
    """The options about ports do not go together."""

    code = "port_options"
    title = "The options about ports do not go together"
    remedy = "Give one TCP port and one serial port at most: --port 8000 --port /dev/ttyUSB0."


class UselessSerialPortError(PortOptionsError):
    """A serial port was given, but no board is to be driven."""

    remedy = (
        "To drive the real board add --driver arduino; a TCP port is a number, such as --port 9000."
    )


def port_options(ports: Sequence[str], serial: str | None) -> list[Option]:
    """What the options mean as settings: a number is the TCP port, all else the serial port.

    Args:
        ports: Values of every --port.
        serial: Value of --serial, if it was given.

    Raises:
        PortOptionsError: more than one port of a kind.
    """
    numbers = [Option(PORT, "server.port", port) for port in ports if _NUMBER.fullmatch(port)]
    names = [Option(PORT, "robot.port", port) for port in ports if not _NUMBER.fullmatch(port)]
    if serial is not None:
        names.append(Option(SERIAL, "robot.port", serial))
    for kind, options in (("TCP", numbers), ("serial", names)):
        if len(options) > 1:
            given = " and ".join(f"{option.flag} {option.value}" for option in options)
            raise PortOptionsError(f"More than one {kind} port was given: {given}.")
    return numbers + names


def require_board_for_serial(options: Sequence[Option], settings: Settings) -> None:
    """Do nothing if a serial port that was given will be used.

    Raises:
        UselessSerialPortError: the robot is the simulator, which needs no port.
    """
    for option in options:
        if option.key == "robot.port" and settings.simulated:
            raise UselessSerialPortError(
                f"{option.flag} {option.value} names the serial port of a board, but the robot is "
                "the simulator, which needs none."
            )
