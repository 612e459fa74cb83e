"""Which source wins, and what the settings become."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.config import (
    ConfigurationFileError,
    Option,
    Settings,
    load_configuration,
    load_settings,
)

pytestmark = pytest.mark.usefixtures("clean_environment")


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_the_defaults_work_without_any_source() -> None:
    configuration = load_configuration()
    assert configuration.settings == Settings()
    assert configuration.origins == {}


def test_option_over_environment_over_file_over_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = write(
        tmp_path / "garage.toml",
        '[server]\nport = 1001\nhost = "0.0.0.0"\n[simulation]\nseed = 1\nspeed = 2.0\n',
    )
    monkeypatch.setenv("PLUGPILOT_SERVER__PORT", "1002")
    monkeypatch.setenv("PLUGPILOT_SIMULATION__SEED", "2")
    configuration = load_configuration(
        file,
        [Option("--seed", "simulation.seed", "3"), Option("--speed", "simulation.speed", None)],
    )
    settings = configuration.settings
    assert settings.simulation.seed == 3
    assert settings.server.port == 1002
    assert settings.simulation.speed == 2.0
    assert settings.server.host == "0.0.0.0"  # noqa: S104 - only read, nothing listens
    assert settings.storage == Settings().storage
    assert configuration.origins == {
        "server.port": "environment variable PLUGPILOT_SERVER__PORT",
        "server.host": str(file),
        "simulation.seed": "option --seed",
        "simulation.speed": str(file),
    }


def test_one_number_of_a_table_keeps_the_other_numbers(tmp_path: Path) -> None:
    file = write(
        tmp_path / "garage.toml", "[camera.optics]\nk1 = -0.1\n[geometry.rho1]\nmax_mm = 400\n"
    )
    settings = load_settings(file)
    default = Settings()
    assert settings.camera.optics == default.camera.optics.model_copy(update={"k1": -0.1})
    assert settings.geometry.rho1.max_mm == 400
    assert settings.geometry.rho1.min_mm == default.geometry.rho1.min_mm


def test_an_empty_table_changes_nothing(tmp_path: Path) -> None:
    assert load_settings(write(tmp_path / "garage.toml", "[server]\n[motion.rho1]\n")) == Settings()


def test_the_file_in_the_working_folder_is_found(clean_environment: Path) -> None:
    write(clean_environment / "plugpilot.toml", "[server]\nport = 1003\n")
    assert load_settings().server.port == 1003


def test_the_file_named_by_the_environment_is_found(
    clean_environment: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(clean_environment / "plugpilot.toml", "[server]\nport = 1003\n")
    named = write(clean_environment / "other.toml", "[server]\nport = 1004\n")
    monkeypatch.setenv("PLUGPILOT_CONFIG", str(named))
    assert load_settings().server.port == 1004


def test_a_table_can_be_one_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_GEOMETRY__RHO1", '{"min_mm": 1, "max_mm": 401}')
    assert load_settings().geometry.rho1.max_mm == 401


def test_settings_made_in_code_ignore_the_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLUGPILOT_SERVER__PORT", "1002")
    assert Settings().server.port == 8000


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"[server]\nport = \n", "line 2, column 8"),
        (b"[server]\nhost = '\xff'\n", "not UTF-8 text (line 2)"),
    ],
)
def test_a_broken_file_is_named_with_the_place(
    tmp_path: Path, content: bytes, expected: str
) -> None:
    file = tmp_path / "garage.toml"
    file.write_bytes(content)
    with pytest.raises(ConfigurationFileError) as caught:
        load_settings(file)
    assert str(file) in caught.value.detail
    assert expected in caught.value.detail
    assert caught.value.code == "configuration_file_unreadable"


def test_a_file_that_was_named_must_exist(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationFileError, match="No such file"):
        load_settings(tmp_path / "missing.toml")


def test_a_folder_is_no_configuration_file(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationFileError, match="Is a directory"):
        load_settings(tmp_path)
