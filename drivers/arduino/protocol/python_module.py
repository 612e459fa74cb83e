"""The protocol as a Python module."""

from __future__ import annotations

from drivers.arduino.protocol.definition import MessageDefinition, Names, ProtocolDefinition

_TOP = '''\
"""Messages between host and motion board.

Generated from messages.toml by generate.py. Do not edit.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum, IntFlag
from struct import Struct
from typing import ClassVar

from drivers.arduino.protocol.message import Message
'''

LINE_LENGTH = 100

_CODES = {"u8": "B", "i8": "b", "u16": "H", "i16": "h", "u32": "I", "i32": "i"}


def python_module(definition: ProtocolDefinition) -> str:
    """The text of the module."""
    parts = [
        f"{_TOP}\n{_constants(definition)}",
        *(_enum(name, names) for name, names in definition.enums.items()),
        *(_flags(name, names) for name, names in definition.flags.items()),
        *(_message(message) for message in definition.messages),
        _table(definition),
    ]
    return "\n\n".join(parts)


def _constants(definition: ProtocolDefinition) -> str:
    lines = [f"PROTOCOL_HASH = 0x{definition.hash:08X}"]
    for name, constant in definition.constants.items():
        lines += [f"{name} = {constant.value}", f'"""{constant.text}."""']
    return "\n".join(lines) + "\n"


def _enum(name: str, names: Names) -> str:
    values = "\n".join(f"    {label} = {number}" for label, number in names.values.items())
    return f'class {name}(IntEnum):\n    """{names.text}."""\n\n{values}\n'


def _flags(name: str, names: Names) -> str:
    values = "\n".join(f"    {label} = 1 << {bit}" for label, bit in names.values.items())
    return f'class {name}(IntFlag):\n    """{names.text}."""\n\n{values}\n'


def _message(message: MessageDefinition) -> str:
    layout = "".join(
        f"{field.count if field.count > 1 else ''}{_CODES[field.type]}" for field in message.fields
    )
    counts = [str(field.count) for field in message.fields]
    shape = f"({counts[0]},)" if len(counts) == 1 else f"({', '.join(counts)})"
    lines = [
        "@dataclass(frozen=True, slots=True)",
        f"class {message.name}(Message):",
        f'    """{message.text}"""',
        "",
        f"    TYPE: ClassVar[int] = 0x{message.type:02X}",
        f"    SEQUENCED: ClassVar[bool] = {message.sequenced}",
        f'    LAYOUT: ClassVar[Struct] = Struct("<{layout}")',
        *_fitting(f"    SHAPE: ClassVar[tuple[int, ...]] = {shape}"),
    ]
    if message.fields:
        lines.append("")
    for field in message.fields:
        kind = "int" if field.count == 1 else f"tuple[{', '.join(['int'] * field.count)}]"
        lines.append(f"    {field.name}: {kind}")
    return "\n".join(lines) + "\n"


def _fitting(line: str) -> list[str]:
    """An assignment of a tuple as the formatter lays it out."""
    if len(line) <= LINE_LENGTH:
        return [line]
    head, _, items = line.partition("(")
    return [f"{head}(", *(f"        {item}," for item in items.rstrip(")").split(", ")), "    )"]


def _table(definition: ProtocolDefinition) -> str:
    rows = "\n".join(f"    {message.name}.TYPE: {message.name}," for message in definition.messages)
    senders = {
        sender: "\n".join(
            f"        {message.name}.TYPE,"
            for message in definition.messages
            if message.sender == sender
        )
        for sender in ("host", "board")
    }
    return (
        f"MESSAGES: dict[int, type[Message]] = {{\n{rows}\n}}\n"
        '"""Every message by its number."""\n\n'
        f"FROM_HOST = frozenset(\n    {{\n{senders['host']}\n    }}\n)\n"
        '"""Numbers of what the host says."""\n\n'
        f"FROM_BOARD = frozenset(\n    {{\n{senders['board']}\n    }}\n)\n"
        '"""Numbers of what the board says."""\n'
    )
