from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from pydantic import ValidationError

from drivers.arduino.protocol import messages
from drivers.arduino.protocol.definition import SOURCE, ProtocolDefinition, load_definition
from drivers.arduino.protocol.generate import HEADER, stale_files


def changed(tmp_path: Path, old: str, new: str) -> ProtocolDefinition:
    text = SOURCE.read_text(encoding="utf-8")
    assert old in text
    copy = tmp_path / "messages.toml"
    copy.write_text(text.replace(old, new, 1), encoding="utf-8")
    return load_definition(copy)


def test_the_generated_files_say_what_the_definition_says() -> None:
    stale = [path.name for path in stale_files(load_definition())]
    assert not stale, "run python -m drivers.arduino.protocol.generate"


def test_explanations_do_not_change_the_hash(tmp_path: Path) -> None:
    definition = changed(tmp_path, "Ask for the board's time.", "What time is it?")
    assert definition.hash == messages.PROTOCOL_HASH


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("value = 20_000", "value = 25_000"),
        ("STALL = 4", "STALL = 14"),
        ('name = "pwm", type = "i16"', 'name = "pwm", type = "u16"'),
        ('name = "pwm"', 'name = "duty"'),
        ("type = 0x25", "type = 0x26"),
        ("MOVING = 6", "MOVING = 12"),
    ],
)
def test_whatever_matters_on_the_wire_changes_the_hash(tmp_path: Path, old: str, new: str) -> None:
    definition = changed(tmp_path, old, new)
    assert definition.hash != messages.PROTOCOL_HASH
    assert stale_files(definition)


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("type = 0x25", "type = 0x24", "same type"),
        ('name = "Segment"', 'name = "Home"', "same name"),
        ('name = "rate", type = "i32", count = 3', 'name = "rate", type = "i32", count = 6', "fit"),
        ('enum = "State"', 'enum = "Stat"', "unknown enums"),
        ("STALL = 4", "STALL = 3", "same number"),
        ('name = "ticks"', 'name = "number"', "same name"),
        ('name = "Ack"\ntype = 0x83', 'name = "Ack"\nsequenced = true\ntype = 0x83', "sequenced"),
    ],
)
def test_a_definition_that_contradicts_itself_is_refused(
    tmp_path: Path, old: str, new: str, complaint: str
) -> None:
    with pytest.raises(ValidationError, match=complaint):
        changed(tmp_path, old, new)


def test_the_header_compiles_for_the_board(tmp_path: Path) -> None:
    """Its static assertions compare every struct with the size on the wire."""
    program = tmp_path / "program.cpp"
    program.write_text(
        '#include "protocol.hpp"\nint main() { return plugpilot::protocol::payload_bytes(1); }\n',
        encoding="utf-8",
    )
    for compiler, options in (("g++", []), ("avr-g++", ["-mmcu=atmega2560", "-Os"])):
        subprocess.run(
            [
                compiler,
                *options,
                *("-std=c++14", "-Wall", "-Wextra", "-pedantic", "-Werror"),
                *("-I", str(HEADER.parent), "-o", str(tmp_path / "program"), str(program)),
            ],
            check=True,
        )
