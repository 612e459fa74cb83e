"""What a person reads when settings cannot be."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.config import InvalidSettingsError, Option, load_settings

pytestmark = pytest.mark.usefixtures("clean_environment")


def problems_of(text: str, *options: Option) -> list[str]:
    Path("garage.toml").write_text(text, encoding="utf-8")
    with pytest.raises(InvalidSettingsError) as caught:
        load_settings(Path("garage.toml"), options)
    assert caught.value.code == "settings_invalid"
    problems: list[str] = caught.value.context["problems"]
    assert all(problem in caught.value.detail for problem in problems)
    return problems


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "[server]\nport = 99999",
            "server.port = 99999 in garage.toml: must be less than or equal to 65535",
        ),
        (
            '[robot]\ndriver = "ardunio"',
            "robot.driver = \"ardunio\" in garage.toml: must be 'simulator' or 'arduino'",
        ),
        (
            "[server]\nprot = 1",
            "server.prot in garage.toml: unknown key; did you mean server.port?",
        ),
        ("[sever]\nport = 1", "sever in garage.toml: unknown key; did you mean server?"),
        ("pre_insertion_distance = 5", "did you mean insertion.pre_insertion_distance_mm?"),
        (
            "[server]\nzzzzzz = 1",
            "server.zzzzzz in garage.toml: unknown key; known here: host, port",
        ),
        ("server = 5", "server = 5 in garage.toml: must be a table"),
        (
            "[geometry.rho1]\nmax_mm = -4",
            "geometry.rho1 in garage.toml: max_mm (-4) must be greater than min_mm (0)",
        ),
        ("[park]\nx_mm = nan", "park.x_mm = NaN in garage.toml: must be a finite number"),
        ("[insertion]\nsettle_s = inf", "must be a finite number"),
        ("[park]\nrho3_mm = 20", "settings in garage.toml: the robot cannot reach [park]: rho3"),
        ("[park]\nx_mm = 100", "the robot cannot reach [park]: rho1"),
        ("[park]\ny_mm = 900", "the robot cannot reach [park]"),
        ("[geometry.rho3]\nmax_mm = 105", "the slide is too short"),
        ("[simulation.parameters.board]\nboot_s = 0", "simulation.parameters.board.boot_s = 0"),
    ],
)
def test_key_value_origin_and_what_may_be(text: str, expected: str) -> None:
    (problem,) = problems_of(text)
    assert expected in problem


def test_all_problems_are_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_PARK__X_MM", "left")
    monkeypatch.setenv("PLUGPILOT_SRVR__PORT", "1")
    problems = problems_of("[server]\nport = -1", Option("--speed", "simulation.speed", "0"))
    assert sorted(problem.split(": ")[0] for problem in problems) == [
        'park.x_mm = "left" in environment variable PLUGPILOT_PARK__X_MM',
        "server.port = -1 in garage.toml",
        'simulation.speed = "0" in option --speed',
        "srvr in environment variable PLUGPILOT_SRVR__PORT",
    ]


def test_the_source_that_won_is_blamed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_SERVER__PORT", "70000")
    (problem,) = problems_of("[server]\nport = 8000")
    assert "environment variable PLUGPILOT_SERVER__PORT" in problem
    assert "garage.toml" not in problem


def test_a_table_in_a_variable_must_be_json(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_SERVER", "port 8000")
    with pytest.raises(InvalidSettingsError, match="PLUGPILOT_SERVER"):
        load_settings()


@pytest.mark.parametrize(
    "text",
    [
        '[station.openevse]\nurl = "http://10.0.0.1"\npassword = 20241199',
        '[station.openevse]\nurl = "http://10.0.0.1"\npassword = ["20241199"]',
        '[station.openevse]\nurl = "http://10.0.0.1"\npassword = { old = "20241199" }',
        '[station.openevse]\nurl = "http://admin:20241199@10.0.0.1"',
        '[[station.openevse]]\nurl = "http://10.0.0.1"\npassword = "20241199"',
        '[station.ocpp]\ncharge_point = "a"\npassword = 20241199',
        'station.openevse = { url = "nonsense", password = "20241199" }',
    ],
)
def test_no_secret_is_ever_told(text: str) -> None:
    for problem in problems_of(text):
        assert "20241199" not in problem
        assert problem.startswith("station.")
