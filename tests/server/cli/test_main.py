"""The command as a person calls it."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner

from server.cli import main

PROJECT = Path(__file__).parents[3]

pytestmark = pytest.mark.usefixtures("clean_environment")


def test_help_lists_the_subcommands_without_importing_them() -> None:
    code = (
        "import sys; from server.cli import main; main(['--help'], standalone_mode=False);"
        "print(*sorted({'numpy', 'pydantic', 'fastapi', 'cv2', 'viser'} & set(sys.modules)),"
        " file=sys.stderr)"
    )
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    for name in ("serve", "simulate", "locate", "config", "version"):
        assert f"\n  {name} " in result.stdout
    assert result.stderr.strip() == ""


@pytest.mark.parametrize("name", main.list_commands(None))  # type: ignore[arg-type]  # not used
def test_every_subcommand_can_be_loaded(name: str) -> None:
    result = CliRunner().invoke(main, [name, "--help"])
    assert result.exit_code == 0, result.output
    assert result.output.startswith(f"Usage: main {name} [OPTIONS]")


def test_an_unknown_subcommand_is_refused() -> None:
    result = CliRunner().invoke(main, ["sevre"])
    assert result.exit_code == 2
    assert "No such command 'sevre'" in result.output


def test_config_prints_the_settings_in_force(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_SERVER__PORT", "8123")
    result = CliRunner().invoke(main, ["config"])
    assert result.exit_code == 0
    assert "port = 8123 # from environment variable PLUGPILOT_SERVER__PORT" in result.output


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["serve", "--port", "99999"], 'server.port = "99999" in option --port'),
        (["serve", "--port", "-1"], 'server.port = "-1" in option --port'),
        (["serve", "--driver", "arduino", "--serial", ""], 'robot.port = "" in option --serial'),
        (["serve", "--speed", "0"], 'simulation.speed = "0" in option --speed: must be greater'),
        (["serve", "--driver", "lego"], 'robot.driver = "lego" in option --driver'),
        (["serve", "--config", "none.toml"], "none.toml cannot be read (No such file"),
        (["config", "--config", "bad.toml"], "bad.toml is not valid TOML"),
    ],
)
def test_wrong_settings_end_in_a_sentence_and_exit_code_2(
    arguments: list[str], expected: str
) -> None:
    Path("bad.toml").write_text("[server\n")
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 2
    assert expected in result.stderr
    assert "Traceback" not in result.output
    assert result.stdout == ""


def test_version() -> None:
    pyproject = tomllib.loads((PROJECT / "pyproject.toml").read_text())
    result = CliRunner().invoke(main, ["version"])
    assert result.output == f"plugpilot {pyproject['project']['version']}\n"
