"""The systemd unit, as systemd itself judges it."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

import server

HOST = Path(server.__file__).parent / "host"
SCREEN_UNIT = HOST / "plugpilot-kiosk.service"
UNIT = HOST / "plugpilot.service"
WORST_EXPOSURE = 2.0
"""On systemd's scale of 0 to 10; a service without sandboxing has 9.6."""


@pytest.fixture
def unit(tmp_path: Path) -> Path:
    """The unit with a program that exists on every machine."""
    if shutil.which("systemd-analyze") is None:
        pytest.skip("install the Debian package systemd")
    content = UNIT.read_text().replace("/opt/plugpilot/.venv/bin/plugpilot", "/bin/true")
    copy = tmp_path / UNIT.name
    copy.write_text(content.replace("Documentation=file:/opt/plugpilot/README.md\n", ""))
    return copy


def _analyze(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["systemd-analyze", *arguments], capture_output=True, text=True, timeout=60, check=False
    )


def test_systemd_understands_every_line(unit: Path) -> None:
    run = _analyze("verify", "--man=no", unit)
    assert run.returncode == 0, run.stderr
    assert unit.name not in run.stderr, run.stderr


def test_the_sandbox_is_tight(unit: Path) -> None:
    run = _analyze("security", "--offline=true", "--no-pager", unit)
    found = re.search(r"exposure level for \S+: (\d+\.\d)", run.stdout)
    assert found is not None, run.stdout + run.stderr
    assert float(found[1]) <= WORST_EXPOSURE, run.stdout


def test_the_account_has_the_groups_that_the_unit_names() -> None:
    account = (HOST / "plugpilot.sysusers").read_text()
    named = re.search(r"^SupplementaryGroups=(.*)$", UNIT.read_text(), re.MULTILINE)
    assert named is not None
    assert set(named[1].split()) == set(re.findall(r"^m plugpilot (\w+)$", account, re.MULTILINE))


def test_systemd_understands_the_unit_of_the_screen(tmp_path: Path) -> None:
    if shutil.which("systemd-analyze") is None:
        pytest.skip("install the Debian package systemd")
    content = re.sub(r"/usr/bin/(cage|curl|chromium)", "/bin/true", SCREEN_UNIT.read_text())
    copy = tmp_path / SCREEN_UNIT.name
    copy.write_text(content.replace("Documentation=file:/opt/plugpilot/README.md\n", ""))
    run = _analyze("verify", "--man=no", copy)
    assert copy.name not in run.stderr, run.stderr
