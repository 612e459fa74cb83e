"""`plugpilot simulate calibration`: before and after, and a campaign that goes on where it was."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from server import simulated_calibration
from server.cli import main
from server.cli.simulated_calibration import as_summary
from server.config.settings import Settings
from server.simulated_calibration import SimulatedCalibration, fitted_distance_mm


def figures(seed: int, *, after: bool = True) -> SimulatedCalibration:
    return SimulatedCalibration(
        seed=seed,
        before_mm=np.linspace(0.0, 2.0, 101),
        after_mm=np.linspace(0.0, 0.1, 101) if after else None,
        lateral_mm=0.05 if after else None,
        found=None,
        inside=7 if after else None,
        jointly=True if after else None,
        poses=25,
        trouble="" if after else "The label has moved.",
        wall_s=1.0,
    )


@pytest.fixture
def computed(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Seeds that were computed: even ones succeed."""
    seeds: list[int] = []

    def compute(settings: Settings) -> SimulatedCalibration:
        seeds.append(settings.simulation.seed)
        return figures(settings.simulation.seed, after=settings.simulation.seed % 2 == 0)

    monkeypatch.setattr(simulated_calibration, "simulate_calibration", compute)
    return seeds


def test_a_campaign_goes_on_where_it_was(computed: list[int], tmp_path: Path) -> None:
    keep = tmp_path / "kept.jsonl"
    arguments = ["simulate", "calibration", "--keep", str(keep), "--json", "--seeds"]
    first = CliRunner().invoke(main, [*arguments, "0-0"])
    assert first.exit_code == 0, first.output
    second = CliRunner().invoke(main, [*arguments, "0-2"])
    assert second.exit_code == 1, "seed 1 has failed"
    assert computed == [0, 1, 2]
    documents = [json.loads(line) for line in second.output.splitlines()]
    assert [one["seed"] for one in documents] == [0, 1, 2]
    assert documents[0]["before_mm"] == [1.0, 1.9, 2.0]
    assert documents[1]["after_mm"] is None
    assert len(keep.read_text().splitlines()) == 3


def test_one_robot_is_shown_before_and_after(computed: list[int]) -> None:
    failed = CliRunner().invoke(main, ["simulate", "calibration", "--seeds", "7"])
    assert failed.exit_code == 1
    assert computed == [7]
    assert "before" in failed.output
    assert "1.900 mm" in failed.output
    assert "The label has moved." in failed.output


def test_the_summary_counts_what_failed() -> None:
    document = {"before_mm": [1, 2, 3], "after_mm": [0.1, 0.2, 0.3], "lateral_mm": 0.04}
    document |= {"robot_s": 30.0, "poses": 25, "inside": 6, "jointly": True, "tip_at_most_mm": 0.25}
    text = as_summary([document, {**document, "lateral_mm": None}])
    assert "1 of 2 robots" in text
    assert "0.040" in text
    assert "0.200" in text
    lines = {line[:30].strip(): line[30:].split("%")[0].strip() for line in text.splitlines()}
    assert lines["tip within 0.15 mm"] == "0.0"
    assert lines["job within 0.10 mm"] == "100.0"
    assert lines["true numbers in stated 95 %"] == "85.7"
    assert lines["tip no more off than stated"] == "100.0"


def test_a_shifted_and_turned_robot_misses_nothing() -> None:
    rng = np.random.default_rng(1)
    wanted = rng.uniform(-100, 100, (40, 3))
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    there = wanted @ turn.T + (3.0, -2.0, 1.0)
    assert fitted_distance_mm(there, wanted).max() < 1e-9
    there[0] += (1.0, 0.0, 0.0)
    assert fitted_distance_mm(there, wanted).max() == pytest.approx(0.95, abs=0.1)
