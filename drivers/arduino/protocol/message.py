"""What all messages have in common: a fixed layout of little-endian integers."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from struct import Struct
from typing import ClassVar, Self


@dataclass(frozen=True, slots=True)
class Message:
    """Base of the generated messages.

    Attributes:
        TYPE: Number in the frame.
        SEQUENCED: It belongs to the host's numbered sequence.
        LAYOUT: Of the payload.
        SHAPE: Number of elements of each field.
    """

    TYPE: ClassVar[int]
    SEQUENCED: ClassVar[bool]
    LAYOUT: ClassVar[Struct]
    SHAPE: ClassVar[tuple[int, ...]]

    def pack(self) -> bytes:
        """The payload.

        Raises:
            struct.error: a number does not fit into its field.
        """
        numbers: list[int] = []
        for value in astuple(self):
            if isinstance(value, tuple):
                numbers.extend(value)
            else:
                numbers.append(value)
        return self.LAYOUT.pack(*numbers)

    @classmethod
    def unpack(cls, payload: bytes) -> Self:
        """The message of a payload.

        Raises:
            struct.error: it has another length.
        """
        numbers = cls.LAYOUT.unpack(payload)
        values: list[int | tuple[int, ...]] = []
        at = 0
        for count in cls.SHAPE:
            values.append(numbers[at] if count == 1 else numbers[at : at + count])
            at += count
        return cls(*values)
