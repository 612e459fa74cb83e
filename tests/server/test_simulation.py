"""Whole jobs from the command line, and what is said about them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from server.cli import main
from server.cli.simulated_job import as_table
from server.config.settings import Settings
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import JobRequest
from server.simulation import SimulatedJob, simulate


@pytest.fixture(scope="module")
def outcome() -> SimulatedJob:
    return simulate(Settings(), JobRequest(type=JobType.PLUG_IN))


def test_the_same_seed_gives_the_same_job(outcome: SimulatedJob) -> None:
    again = simulate(Settings(), JobRequest(type=JobType.PLUG_IN))
    assert again.phases == outcome.phases
    assert again.lateral_error_mm == outcome.lateral_error_mm
    assert again.max_force_n == outcome.max_force_n
    assert again.duration_s == outcome.duration_s


def test_the_phases_follow_one_another_to_the_end(outcome: SimulatedJob) -> None:
    assert outcome.succeeded
    names = [phase.phase for phase in outcome.phases]
    assert names == [phase.value for phase in list(JobPhase)[:5]]
    for phase, following in zip(outcome.phases, outcome.phases[1:], strict=False):
        assert phase.started_s + phase.duration_s == pytest.approx(following.started_s, abs=1e-5)
    seated_s = outcome.job.result.plugged_after_s
    assert outcome.duration_s == seated_s
    last = outcome.phases[-1]
    assert last.started_s == pytest.approx(outcome.duration_s, abs=0.05)


def test_the_truth_is_not_what_the_robot_believes(outcome: SimulatedJob) -> None:
    assert outcome.lateral_error_mm is not None
    assert outcome.job.result.lateral_error_mm is not None
    assert outcome.lateral_error_mm > outcome.job.result.lateral_error_mm
    assert outcome.max_force_n >= (outcome.job.result.max_force_n or 0.0)


def test_one_job_as_json(clean_environment: Path) -> None:
    del clean_environment
    run = CliRunner().invoke(main, ["simulate", "job", "--seed", "3", "--json"])
    assert run.exit_code == 0, run.output
    document = json.loads(run.output)
    assert document["seed"] == 3
    assert document["succeeded"] is True
    assert document["state"] == JobState.SUCCEEDED.value
    assert document["error"] is None
    assert 1.0 < document["duration_s"] / document["limit_duration_s"] <= 1.25


def test_a_job_as_a_table(outcome: SimulatedJob) -> None:
    table = as_table(outcome)
    assert "inserting" in table
    assert f"Plugged in after {outcome.duration_s:.2f} s" in table
    assert "The job succeeded." in table


def test_a_job_that_fails_says_why_and_exits_with_1(clean_environment: Path) -> None:
    config = clean_environment / "plugpilot.toml"
    config.write_text("[insertion]\nmax_lateral_sigma_mm = 0.001\n")
    run = CliRunner().invoke(main, ["simulate", "campaign", "--seeds", "4"])
    assert run.exit_code == 1
    assert "seed    4  FAILED" in run.output
    assert "0 of 1 succeeded" in run.output


def test_a_configuration_for_a_real_robot_is_simulated_all_the_same(
    clean_environment: Path,
) -> None:
    config = clean_environment / "plugpilot.toml"
    config.write_text('[robot]\ndriver = "arduino"\n')
    run = CliRunner().invoke(main, ["simulate", "campaign", "--seeds", "4-4"])
    assert run.exit_code == 0, run.output
    assert "1 of 1 succeeded" in run.output


@pytest.mark.parametrize(
    "options",
    [
        ["job", "--seed", "many"],
        ["job", "--seed", "-1"],
        ["job", "--type", "unplug"],
        ["job", "--energy-wh", "500"],
        ["job", "--type", "charge", "--energy-wh", "0"],
        ["job", "--type", "charge", "--energy-wh", "nan"],
        ["campaign", "--seeds", "9-3"],
        ["campaign", "--seeds", "a-b"],
        ["campaign", "--seeds", ""],
    ],
)
def test_wrong_usage_is_told_and_exits_with_2(options: list[str], clean_environment: Path) -> None:
    del clean_environment
    run = CliRunner().invoke(main, ["simulate", *options])
    assert run.exit_code == 2, run.output
    assert options[-2] in run.output or "simulation.seed" in run.output
    assert "Traceback" not in run.output
