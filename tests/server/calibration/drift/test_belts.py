"""What a hundred jobs teach of the belts, and what they must not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from server.calibration.drift.belts import BOUND, BeltMemory, LookPair, seen_shift
from server.calibration.drift.judging import belt_hints, drift_of
from tests.server.calibration.robot.built import DRAWN, Workshop
from twin.as_built import PlanarAsBuilt

PARKED = np.array([650.0, 335.0])
STRETCH = 0.002


def calibrated(seed: int) -> tuple[Workshop, PlanarAsBuilt]:
    """A robot, and what a routine has found of it: scales are off by what a rule is."""
    robot = Workshop.robot(seed)
    measured = robot.built.model_copy(
        update={"left_scale": robot.known.left_scale, "right_scale": robot.known.right_scale}
    )
    return robot, measured


def stretched(robot: Workshop, left: float, right: float = 0.0) -> Workshop:
    built = robot.built
    changed = {
        "left_scale": built.left_scale * (1 + left),
        "right_scale": built.right_scale * (1 + right),
    }
    return replace(robot, built=built.model_copy(update=changed))


def job(robot: Workshop, measured: PlanarAsBuilt, *, knocked_mm: float = 0.0) -> LookPair:
    """One job: a look from where the robot waits, and one from before the socket."""
    parked_mm = robot.rng.uniform(-1, 1, 2) * (60.0, 40.0)
    robot = replace(robot, way_mm=robot.way_mm + np.array([*parked_mm, 0.0]))
    before = measured.inverse_many(PARKED)
    there = measured.inverse_many(PARKED + parked_mm - np.array([90.0, 0.0]))
    return LookPair("zoe", robot.look(before), robot.look(there, label_moved_mm=knocked_mm))


def errors_mm(robot: Workshop, believed: PlanarAsBuilt) -> NDArray[np.float64]:
    return robot.error_mm(believed)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_belt_that_stretches_over_a_hundred_jobs_stays_accurate_and_is_reported(
    seed: int, side: str
) -> None:
    robot, measured = calibrated(seed)
    memory, reported_after = BeltMemory(), None
    for number in range(1, 101):
        by = STRETCH * number / 100
        now = stretched(robot, by) if side == "left" else stretched(robot, 0.0, by)
        memory = memory.learn(seen_shift(measured, now.R_base_camera, job(now, measured)))
        drift = drift_of(memory, DRAWN, measured, 0.03)
        if reported_after is None and belt_hints(drift):
            reported_after = number
    assert memory.jobs >= 97
    change = memory.belts[0 if side == "left" else 1]
    assert change == pytest.approx(STRETCH, abs=6e-4)
    believed = np.percentile(errors_mm(now, memory.corrected(measured)), 95)
    ignored = np.percentile(errors_mm(now, measured), 95)
    assert believed < 0.15
    assert ignored > 2 * believed
    assert reported_after is not None
    assert 30 < reported_after < 100
    (hint,) = belt_hints(drift)
    assert hint.code == "belts_drifted"
    assert f"The {side} belt" in hint.text


@pytest.mark.parametrize("seed", range(4))
def test_a_robot_that_does_not_change_is_left_alone(seed: int) -> None:
    robot, measured = calibrated(seed)
    memory = BeltMemory()
    for _ in range(100):
        memory = memory.learn(seen_shift(measured, robot.R_base_camera, job(robot, measured)))
    drift = drift_of(memory, DRAWN, measured, 0.03)
    assert not belt_hints(drift)
    assert drift.moved_mm < 0.15
    before, after = (errors_mm(robot, one).max() for one in (measured, memory.corrected(measured)))
    assert after < before + 0.06


def test_a_label_that_is_knocked_off_during_a_job_is_not_learnt() -> None:
    robot, measured = calibrated(1)
    memory = BeltMemory()
    for _ in range(20):
        memory = memory.learn(seen_shift(measured, robot.R_base_camera, job(robot, measured)))
    for knocks in range(1, 4):
        hit = job(robot, measured, knocked_mm=5.0)
        after = memory.learn(seen_shift(measured, robot.R_base_camera, hit))
        assert (after.state, after.covariance) == (memory.state, memory.covariance)
        assert after.refused_in_a_row == knocks
        memory = after
    assert [hint.code for hint in belt_hints(drift_of(memory, DRAWN, measured, 0.03))] == [
        "looks_misfit"
    ]
    memory = memory.learn(seen_shift(measured, robot.R_base_camera, job(robot, measured)))
    assert memory.refused_in_a_row == 0


def test_a_label_that_was_stuck_elsewhere_between_jobs_teaches_nothing_wrong() -> None:
    robot, measured = calibrated(2)
    memory = BeltMemory()
    for number in range(60):
        elsewhere = replace(robot, way_mm=robot.way_mm + (5.0 if number >= 30 else 0.0))
        pair = job(elsewhere, measured)
        memory = memory.learn(seen_shift(measured, robot.R_base_camera, pair))
    assert memory.refused_in_a_row == 0
    assert np.abs(memory.belts).max() < 1e-3


def test_nothing_is_learnt_beyond_the_bound() -> None:
    robot, measured = calibrated(3)
    memory = BeltMemory()
    for number in range(600):
        now = stretched(robot, 0.01 * number / 600)
        memory = memory.learn(seen_shift(measured, now.R_base_camera, job(now, measured)))
    assert np.abs(memory.belts).max() <= BOUND
    assert memory.at_bound
