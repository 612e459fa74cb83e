"""The protocol as a C++14 header for firmware and host tests."""

from __future__ import annotations

from drivers.arduino.protocol.definition import (
    CRC_BYTES,
    HEADER_BYTES,
    MessageDefinition,
    MessageField,
    Names,
    ProtocolDefinition,
)

_TOP = """\
// Generated from protocol/messages.toml by protocol/generate.py. Do not edit.
//
// The structs are payloads as they travel: packed, little endian like the AVR and every host that
// runs the tests. Copy them from and to frames with memcpy.
#pragma once

#include <stdint.h>

namespace plugpilot {
namespace protocol {
"""

_BOTTOM = """\
}  // namespace protocol
}  // namespace plugpilot
"""


def cpp_header(definition: ProtocolDefinition) -> str:
    """The text of the header."""
    parts = [
        _TOP,
        _constants(definition),
        *(_enum(name, names) for name, names in definition.enums.items()),
        *(_flags(name, names) for name, names in definition.flags.items()),
        _message_types(definition),
        *(_struct(message) for message in definition.messages),
        _payload_bytes(definition),
        _is_sequenced(definition),
        _BOTTOM,
    ]
    return "\n".join(parts)


def _constants(definition: ProtocolDefinition) -> str:
    largest = max(message.size_bytes for message in definition.messages)
    lines = [f"constexpr uint32_t PROTOCOL_HASH = 0x{definition.hash:08X}UL;"]
    for name, constant in definition.constants.items():
        kind, suffix = ("uint32_t", "UL") if constant.value > 0xFFFF else ("uint16_t", "")
        if constant.value <= 0xFF:
            kind = "uint8_t"
        lines.append(f"constexpr {kind} {name} = {constant.value}{suffix};  // {constant.text}")
    lines += [
        f"constexpr uint8_t HEADER_BYTES = {HEADER_BYTES};  // length, type, seq, ack",
        f"constexpr uint8_t CRC_BYTES = {CRC_BYTES};",
        f"constexpr uint8_t MAX_PAYLOAD_BYTES = {largest};",
    ]
    return "\n".join(lines) + "\n"


def _enum(name: str, names: Names) -> str:
    values = "\n".join(f"  {label} = {number}," for label, number in names.values.items())
    return f"// {names.text}.\nenum class {name} : uint8_t {{\n{values}\n}};\n"


def _flags(name: str, names: Names) -> str:
    values = "\n".join(f"  {label} = 1U << {bit}," for label, bit in names.values.items())
    return f"// {names.text}.\nenum {name} : uint16_t {{\n{values}\n}};\n"


def _message_types(definition: ProtocolDefinition) -> str:
    values = "\n".join(
        f"  {message.constant} = 0x{message.type:02X}," for message in definition.messages
    )
    return f"enum class MessageType : uint8_t {{\n{values}\n}};\n"


def _struct(message: MessageDefinition) -> str:
    if not message.fields:
        return f"// {message.text}\nstruct {message.name} {{}};  // no payload\n"
    members = "\n".join(_member(field) for field in message.fields)
    return (
        f"// {message.text}\n"
        f"struct __attribute__((packed)) {message.name} {{\n{members}\n}};\n"
        f"static_assert(sizeof({message.name}) == {message.size_bytes},"
        f' "{message.name} has another size on the wire");\n'
    )


def _member(field: MessageField) -> str:
    wire = f"{'u' if field.type[0] == 'u' else ''}int{field.type[1:]}_t"
    array = f"[{field.count}]" if field.count > 1 else ""
    unit = f" [{field.unit}]" if field.unit else ""
    return f"  {field.enum or wire} {field.name}{array};  // {field.text}{unit}"


def _payload_bytes(definition: ProtocolDefinition) -> str:
    cases = "\n".join(
        f"    case MessageType::{message.constant}: return {message.size_bytes};"
        for message in definition.messages
    )
    return (
        "constexpr uint8_t UNKNOWN_TYPE = 0xFF;\n\n"
        "// Payload size of a message, UNKNOWN_TYPE for a number that is none.\n"
        "inline uint8_t payload_bytes(uint8_t type) {\n"
        "  switch (static_cast<MessageType>(type)) {\n"
        f"{cases}\n"
        "  }\n  return UNKNOWN_TYPE;\n}\n"
    )


def _is_sequenced(definition: ProtocolDefinition) -> str:
    cases = "\n".join(
        f"    case MessageType::{message.constant}:"
        for message in definition.messages
        if message.sequenced
    )
    return (
        "// Whether a message belongs to the host's numbered sequence.\n"
        "inline bool is_sequenced(uint8_t type) {\n"
        "  switch (static_cast<MessageType>(type)) {\n"
        f"{cases}\n      return true;\n"
        "    default:\n      return false;\n  }\n}\n"
    )
