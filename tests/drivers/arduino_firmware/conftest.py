"""The firmware's core, compiled for this computer."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from drivers.arduino import protocol

FIRMWARE = Path(protocol.__file__).parents[1] / "firmware"


@dataclass(frozen=True, slots=True)
class Firmware:
    """Its sources, and a folder for what is made from them."""

    build: Path

    def make(self, target: str) -> str:
        """Make something and return what was said."""
        made = subprocess.run(
            ["make", "-j2", "-C", str(FIRMWARE), target, f"BUILD={self.build}"],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "MAKEFLAGS": ""},
        )
        assert made.returncode == 0, made.stdout + made.stderr
        return made.stdout

    def run(self, program: str, lines: list[str]) -> list[str]:
        """What a program of the target ``programs`` answers to some lines."""
        ran = subprocess.run(
            [str(self.build / "host" / program)],
            input="\n".join(lines) + "\n",
            capture_output=True,
            text=True,
            check=False,
        )
        assert ran.returncode == 0, ran.stderr
        return ran.stdout.splitlines()


@pytest.fixture(scope="session")
def firmware(tmp_path_factory: pytest.TempPathFactory) -> Firmware:
    if shutil.which("g++") is None or shutil.which("make") is None:
        pytest.skip("needs the Debian packages g++ and make")
    return Firmware(tmp_path_factory.mktemp("firmware"))


@pytest.fixture(scope="session")
def run(firmware: Firmware) -> Callable[[str, list[str]], list[str]]:
    """Runs one of the firmware's programs."""
    firmware.make("programs")
    return firmware.run
