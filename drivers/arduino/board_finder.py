"""Which serial port is the motion board's."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from serial.tools.list_ports import comports

from drivers.arduino.errors import BoardNotFoundError

AUTO = "auto"

USB_IDS = {
    (0x1A86, 0x7523): "CH340",  # the Me Auriga's bridge
    (0x1A86, 0x5523): "CH341",
    (0x2341, 0x0010): "Arduino Mega 2560",
    (0x2341, 0x0042): "Arduino Mega 2560 R3",
    (0x2A03, 0x0010): "Arduino Mega 2560",
    (0x2A03, 0x0042): "Arduino Mega 2560 R3",
}
"""Vendor and product of the USB bridges that such boards have."""


class UsbPort(Protocol):
    """What is known of a serial port."""

    device: str
    vid: int | None
    pid: int | None


def find_board(port: str, ports: Iterable[UsbPort] | None = None) -> str:
    """The device to open.

    Args:
        port: From the configuration: a device, or "auto" to look for it.
        ports: To choose from; None asks the operating system.

    Raises:
        BoardNotFoundError: "auto" found none, or more than one.
    """
    if port != AUTO:
        return port
    known = comports() if ports is None else ports
    found = sorted(p.device for p in known if (p.vid, p.pid) in USB_IDS)
    if not found:
        raise BoardNotFoundError(
            "No motion board was found on USB. Check its cable and its power, or name its port in "
            "robot.port."
        )
    if len(found) > 1:
        raise BoardNotFoundError(
            f"Several ports could be the motion board: {', '.join(found)}. Name one of them in "
            "robot.port."
        )
    return found[0]
