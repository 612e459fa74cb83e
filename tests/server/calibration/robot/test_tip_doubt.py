"""What the tip may still miss is told before anybody relies on it."""

from __future__ import annotations

import numpy as np
import pytest

from server.calibration.grade import Grade
from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.solve import solve_robot
from server.calibration.robot.tip_doubt import tip_doubt
from server.calibration.robot.unknowns import MECHANISM, NAMES
from server.calibration.robot.verdict import judge
from tests.server.calibration.robot.built import DRAWN, R_DRAWN, Workshop
from twin.as_built import PlanarAsBuilt
from twin.kinematics import alpha


def test_the_derivatives_of_the_platform_are_its_slopes() -> None:
    unknowns = solve_robot(Workshop.robot(1).looks(), DRAWN, R_DRAWN).unknowns
    sent = np.array([[560.0, 250.0], [740.0, 430.0]])
    rho = unknowns.built.inverse_many(sent)
    slopes = unknowns.tip_derivatives(sent)
    for number, name in enumerate(NAMES[MECHANISM]):
        step = np.zeros(len(NAMES))
        step[number] = 1e-3 if name.endswith("mm") else 1e-6
        off = unknowns.stepped(step).built.forward_many(rho) - sent
        np.testing.assert_allclose(
            slopes[..., number], off / step[number], rtol=1e-3, atol=1e-3, err_msg=name
        )


def test_it_holds_what_the_platform_really_misses() -> None:
    held = []
    for seed in range(30):
        robot = Workshop.sagging(seed)
        found = solve_robot(robot.looks(), DRAWN, R_DRAWN, robot.known)
        missed_mm = np.percentile(robot.error_mm(found.unknowns.built), 95)
        doubt = tip_doubt(found)
        assert doubt.likely_mm < doubt.at_most_mm < 0.3, (
            "places of chance tell less than chosen ones"
        )
        held.append(missed_mm < doubt.at_most_mm)
    assert np.mean(held) >= 0.95


@pytest.mark.parametrize("seed", [1, 2])
def test_looks_from_a_corner_only_are_not_called_good(seed: int) -> None:
    robot = Workshop.robot(seed)
    places = np.array([600.0, 260.0]) + robot.rng.uniform(-30, 30, (25, 2))
    looks = [robot.look(rho) for rho in alpha.inverse_many(DRAWN, places)]
    found = solve_robot(looks, DRAWN, R_DRAWN, robot.known)
    verdict = judge(found, looks, robot.known, PlanarAsBuilt.as_drawn(DRAWN))
    assert verdict.held_back_mm < 0.06, "what was held back lies in the same corner"
    assert verdict.grade is not Grade.GOOD
    assert verdict.tip.at_most_mm > 0.2
    assert any("edges of the workspace" in remark for remark in verdict.remarks)


def test_belts_that_nobody_measured_are_asked_for() -> None:
    robot = Workshop.robot(3)
    looks = robot.looks()
    verdict = judge(
        solve_robot(looks, DRAWN, R_DRAWN, KnownBefore()), looks, KnownBefore(),
        PlanarAsBuilt.as_drawn(DRAWN),
    )  # fmt: skip
    assert verdict.grade is not Grade.GOOD
    assert any("measure the belts over 400 mm" in remark for remark in verdict.remarks)
