"""Writes the C++ header and the Python module of the protocol.

Run ``python -m drivers.arduino.protocol.generate`` after every change of messages.toml;
``--check`` only tells whether that was forgotten.
"""

from __future__ import annotations

import sys
from pathlib import Path

from drivers.arduino.protocol.cpp_header import cpp_header
from drivers.arduino.protocol.definition import ProtocolDefinition, load_definition
from drivers.arduino.protocol.python_module import python_module

HEADER = Path(__file__).parents[1] / "firmware" / "core" / "protocol.hpp"
MODULE = Path(__file__).with_name("messages.py")


def stale_files(definition: ProtocolDefinition) -> dict[Path, str]:
    """The generated files that do not say what the definition says, with what they should say."""
    wanted = {HEADER: cpp_header(definition), MODULE: python_module(definition)}
    return {
        path: text
        for path, text in wanted.items()
        if not path.exists() or path.read_text(encoding="utf-8") != text
    }


def main(arguments: list[str]) -> int:
    """Write what is stale, or with ``--check`` complain about it."""
    stale = stale_files(load_definition())
    if "--check" in arguments:
        for path in stale:
            sys.stderr.write(
                f"{path.name} is stale: run python -m drivers.arduino.protocol.generate\n"
            )
        return 1 if stale else 0
    for path, text in stale.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
