"""Limits of forces that contradict each other are refused with the names of both."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.config.errors import InvalidSettingsError
from server.config.forces import loads_at_limits
from server.config.loading import load_settings
from server.config.settings import Settings


@pytest.mark.parametrize(
    ("toml", "names"),
    [
        (
            "[insertion]\nforce_limit_n = 140\n[actuators]\nrho3_n = 120",
            ("insertion.force_limit_n = 140 N", "actuators.rho3_n is 120 N"),
        ),
        (
            "[insertion]\nwithdrawal_force_limit_n = 99\n[actuators]\nrho3_n = 100",
            (
                "insertion.withdrawal_force_limit_n = 99 N takes 101.9 N",
                "actuators.rho3_n is 100 N",
            ),
        ),
        (
            "[robot.board.slide]\nforce_max_n = 70\nforce_limit_n = 60",
            ("insertion.force_limit_n = 79 N", "robot.board.slide.force_max_n = 70 N"),
        ),
        (
            "[robot.board.slide]\nforce_limit_n = 140\n[actuators]\nrho3_n = 120",
            ("robot.board.slide.force_limit_n = 140 N", "actuators.rho3_n = 120 N"),
        ),
        (
            "[robot.board.slide]\nforce_max_n = 120",
            ("actuators.rho3_n = 150 N", "robot.board.slide.force_max_n = 120 N"),
        ),
        (
            "[simulation.parameters.drives]\nmax_force_n = 100",
            ("actuators.rho3_n = 150 N", "simulation.parameters.drives.max_force_n = 100 N"),
        ),
    ],
)
def test_a_contradiction_names_both_settings(
    tmp_path: Path, toml: str, names: tuple[str, ...]
) -> None:
    file = tmp_path / "plugpilot.toml"
    file.write_text(toml)
    with pytest.raises(InvalidSettingsError) as caught:
        load_settings(file)
    for name in names:
        assert name in str(caught.value)


def test_limits_that_agree_are_taken(tmp_path: Path) -> None:
    file = tmp_path / "plugpilot.toml"
    file.write_text(
        "[insertion]\nforce_limit_n = 60\nwithdrawal_force_limit_n = 65\n"
        "[actuators]\nrho3_n = 90\n[robot.board.slide]\nforce_max_n = 90\n"
    )
    assert load_settings(file).actuators.rho3_n == 90


def test_plans_are_judged_by_the_largest_forces_that_a_job_may_use() -> None:
    settings = Settings()
    loads = loads_at_limits(settings.loads, settings.insertion)
    assert loads.insertion_force_n == settings.insertion.force_limit_n
    assert loads.withdrawal_force_n == settings.insertion.withdrawal_force_limit_n
    assert loads.cable_mass_kg == settings.loads.cable_mass_kg
