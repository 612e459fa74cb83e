"""Builds the firmware and the simulator that runs it."""

from __future__ import annotations

import fcntl
import shutil
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

PROJECT = Path(__file__).parents[2]
FIRMWARE = PROJECT / "drivers" / "arduino" / "firmware"
SIMULATOR = PROJECT / "tests" / "rig" / "auriga"

PACKAGES: Mapping[str, Callable[[], bool]] = {
    "make": lambda: shutil.which("make") is not None,
    "g++": lambda: shutil.which("g++") is not None,
    "gcc-avr": lambda: shutil.which("avr-g++") is not None,
    "avr-libc": lambda: _exists("/usr/lib/avr/include/avr/io.h"),
    "libsimavr-dev": lambda: _exists("/usr/include/simavr/sim_avr.h"),
    "libelf-dev": lambda: _exists("/usr/include/libelf.h"),
}
"""Debian packages that the rig needs, and whether they are there."""


@dataclass(frozen=True, slots=True)
class Programs:
    """What was built.

    Attributes:
        firmware: As the compiler links it for the board.
        simulator: Runs it.
    """

    firmware: Path
    simulator: Path


class BuildError(RuntimeError):
    """A compiler has refused; the message is its own."""


def missing_packages() -> list[str]:
    """Names of the Debian packages that the rig needs and this machine has not."""
    return [name for name, present in PACKAGES.items() if not present()]


def build_programs() -> Programs:
    """Build what is not up to date.

    Whoever comes while another process builds waits for it.

    Raises:
        BuildError: it cannot be built.
    """
    with (SIMULATOR / "Makefile").open() as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        _make(FIRMWARE, "build/firmware.elf")
        _make(SIMULATOR, "all")
    return Programs(FIRMWARE / "build" / "firmware.elf", SIMULATOR / "build" / "auriga")


def _make(folder: Path, target: str) -> None:
    made = subprocess.run(
        ["make", "--silent", "-j2", f"--directory={folder}", target],
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode != 0:
        raise BuildError(f"make {target} in {folder.name} failed:\n{made.stdout}{made.stderr}")


def _exists(path: str) -> bool:
    return Path(path).exists()
