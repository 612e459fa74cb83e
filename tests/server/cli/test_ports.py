"""Which port an option of `plugpilot serve` means."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from server import serving
from server.cli import main
from server.config import Settings

pytestmark = pytest.mark.usefixtures("clean_environment")

TCP, SERIAL = 8000, "auto"


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[Settings]:
    """The settings of every server that was to be run."""
    settings: list[Settings] = []
    monkeypatch.setattr(serving, "serve", settings.append)
    return settings


@pytest.mark.parametrize(
    ("options", "tcp", "serial"),
    [
        (["--port", "/dev/ttyUSB0"], TCP, "/dev/ttyUSB0"),
        (["--port", "COM3"], TCP, "COM3"),
        (["--port", "auto"], TCP, "auto"),
        (
            ["--port", "/dev/serial/by-id/usb-1a86_8000-if00"],
            TCP,
            "/dev/serial/by-id/usb-1a86_8000-if00",
        ),
        (["--port", "9000"], 9000, SERIAL),
        (["--port", "0"], 0, SERIAL),
        (["--port", "9000", "--port", "/dev/ttyACM1"], 9000, "/dev/ttyACM1"),
        (["--port", "/dev/ttyACM1", "--port", "9000"], 9000, "/dev/ttyACM1"),
        (["--serial", "/dev/ttyUSB0"], TCP, "/dev/ttyUSB0"),
        (["--port", "9000", "--serial", "7"], 9000, "7"),
        ([], TCP, SERIAL),
    ],
)
def test_a_number_is_a_tcp_port_and_a_name_is_a_serial_port(
    started: list[Settings], options: list[str], tcp: int, serial: str
) -> None:
    result = CliRunner().invoke(main, ["serve", "--driver", "arduino", *options])
    assert result.exit_code == 0, result.output
    (settings,) = started
    assert settings.server.port == tcp
    assert settings.robot.port == serial
    assert settings.robot.driver == "arduino"


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["--port", "/dev/ttyUSB0"], "--port /dev/ttyUSB0 names the serial port of a board"),
        (["--serial", "COM3", "--driver", "simulator"], "--serial COM3 names the serial port"),
        (["--port", "high"], "a TCP port is a number"),
        (["--serial", "auto"], "add --driver arduino"),
        (["--port", "8000", "--port", "9000"], "More than one TCP port was given: --port 8000"),
        (
            ["--driver", "arduino", "--port", "/dev/ttyUSB0", "--serial", "/dev/ttyUSB1"],
            "More than one serial port was given: --port /dev/ttyUSB0 and --serial /dev/ttyUSB1",
        ),
    ],
)
def test_ports_that_do_not_go_together_are_refused(
    started: list[Settings], options: list[str], expected: str
) -> None:
    result = CliRunner().invoke(main, ["serve", *options])
    assert result.exit_code == 2
    assert expected in result.stderr
    assert "Traceback" not in result.output
    assert started == []


def test_a_serial_port_in_the_settings_does_not_keep_the_simulator_from_starting(
    started: list[Settings], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PLUGPILOT_ROBOT__PORT", "/dev/ttyUSB0")
    assert CliRunner().invoke(main, ["serve", "--port", "9000"]).exit_code == 0
    (settings,) = started
    assert settings.robot.port == "/dev/ttyUSB0"
    assert settings.server.port == 9000
