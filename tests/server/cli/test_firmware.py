"""`plugpilot firmware`, with stand-ins for the tools that are not part of this project."""

from __future__ import annotations

import os
import pty
import shutil
import threading
from pathlib import Path

import pytest
from click.testing import CliRunner

from drivers.arduino.link.frames import Frame, encode_frame
from drivers.arduino.protocol import messages
from server.cli import firmware, main

pytestmark = pytest.mark.usefixtures("clean_environment")

TOOLS = ("make", "avr-g++", "avr-size", "avrdude")


@pytest.fixture
def tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Stand-ins that write down how they were called and obey. Returns their notebook."""
    folder, notebook = tmp_path / "tools", tmp_path / "calls.txt"
    folder.mkdir()
    for tool in TOOLS:
        script = folder / tool
        script.write_text(f'#!/bin/sh\necho {tool} "$@" >> {notebook}\nexit ${{EXIT:-0}}\n')
        script.chmod(0o755)
    header = tmp_path / "io.h"
    header.touch()
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")
    monkeypatch.setattr(firmware, "AVR_HEADER", header)
    return notebook


def test_missing_tools_are_named_with_their_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda tool: None if tool.startswith("avr") else tool)
    monkeypatch.setattr(firmware, "AVR_HEADER", Path("/nowhere/io.h"))
    result = CliRunner().invoke(main, ["firmware", "flash", "--port", "/dev/ttyUSB7"])
    assert result.exit_code == 2
    assert "missing: gcc-avr, binutils-avr, avrdude, avr-libc." in result.output
    assert "sudo apt install" in result.output


def test_build_calls_make_in_the_sources(tools: Path, tmp_path: Path) -> None:
    result = CliRunner().invoke(main, ["firmware", "build", "--output", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    assert tools.read_text() == f"make -C {firmware.SOURCES} all BUILD={tmp_path / 'out'}\n"
    assert (firmware.SOURCES / "Makefile").is_file()


def test_flash_writes_to_the_named_port(tools: Path) -> None:
    result = CliRunner().invoke(main, ["firmware", "flash", "--port", "/dev/ttyUSB7"])
    assert result.exit_code == 0, result.output
    assert tools.read_text().startswith(f"make -C {firmware.SOURCES} flash BUILD=")
    assert tools.read_text().endswith(" PORT=/dev/ttyUSB7\n")
    assert "The firmware is in the board at /dev/ttyUSB7." in result.output


def test_a_failure_of_make_is_told(tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("EXIT", "2")
    result = CliRunner().invoke(main, ["firmware", "build"])
    assert result.exit_code == 2
    assert "`make all` failed" in result.output
    assert tools.exists()


def test_monitor_prints_the_hello_of_a_board() -> None:
    board, port = pty.openpty()
    hello = messages.Hello(
        protocol_hash=messages.PROTOCOL_HASH,
        session=0,
        board=1,
        firmware_major=0,
        firmware_minor=1,
        firmware_patch=0,
        boot_id=77,
        reset_cause=1,
        previous_fault=0,
        state=0,
        queue_capacity=16,
        segment_ticks=400,
        tick_hz=20_000,
        config_crc=0,
        tick=0,
    )
    heard = threading.Event()

    def say_hello() -> None:  # again and again: opening a port throws away what waits there
        while not heard.wait(0.01):
            os.write(board, b"noise\0" + encode_frame(Frame(0, 0, hello)))

    speaker = threading.Thread(target=say_hello)
    speaker.start()
    try:
        result = CliRunner().invoke(
            main, ["firmware", "monitor", "--port", os.ttyname(port), "--seconds", "0.3"]
        )
    finally:
        heard.set()
        speaker.join()
        os.close(board)
        os.close(port)
    assert result.exit_code == 0, result.output
    assert "Hello(" in result.output
    assert "boot_id=77" in result.output


def test_monitor_says_that_a_port_does_not_exist() -> None:
    result = CliRunner().invoke(main, ["firmware", "monitor", "--port", "/dev/none"])
    assert result.exit_code == 2
    assert "/dev/none cannot be read" in result.output
