"""The configuration that a fake board was given."""

from __future__ import annotations

from drivers.arduino.configuration import configuration_crc
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import Refusal

ORDER = (0, 1, 2, messages.ConfigRho3.TYPE, messages.ConfigHoming.TYPE)
"""Axes by their number, the rest by their type: the order of the CRC."""


class FakeConfiguration:
    """Parts as they arrive, in force from the commit."""

    def __init__(self) -> None:
        self._parts: dict[int, Message] = {}
        self.crc = 0

    def put(self, part: Message) -> None:
        """Take a part."""
        number = part.axis if isinstance(part, messages.ConfigAxis) else part.TYPE
        self._parts[number] = part

    def commit(self, crc: int) -> Refusal:
        """Put it in force if it is whole."""
        parts = tuple(self._parts[number] for number in ORDER if number in self._parts)
        if len(parts) < len(ORDER) or configuration_crc(parts) != crc:
            return Refusal.CONFIG_CRC
        self.crc = crc
        return Refusal.NONE

    @property
    def rho1(self) -> messages.ConfigAxis:
        """Of the first carriage."""
        axis = self._parts[0]
        assert isinstance(axis, messages.ConfigAxis)
        return axis

    @property
    def homing(self) -> messages.ConfigHoming:
        """Of homing."""
        homing = self._parts[messages.ConfigHoming.TYPE]
        assert isinstance(homing, messages.ConfigHoming)
        return homing
