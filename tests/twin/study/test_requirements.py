from __future__ import annotations

from typing import Any

import pytest

from twin.geometry import RobotGeometry
from twin.statics import ActuatorLimits, Loads
from twin.study.demands import Demands
from twin.study.requirements import Outcome, Requirement, check_requirements

MET, NOT_MET, OPEN = Outcome.MET, Outcome.NOT_MET, Outcome.NOT_DECIDABLE


def table(
    change: dict[str, Any] | None = None, demands: Demands | None = None
) -> list[Requirement]:
    return list(check_requirements(RobotGeometry.model_validate(change or {}), demands))


def test_the_default_robot() -> None:
    rows = table()
    assert "".join(row.key for row in rows) == "abcdefghijk"
    outcomes = [row.outcome for row in rows]
    assert outcomes == [MET, MET, MET, MET, MET, OPEN, OPEN, MET, MET, OPEN, MET]
    assert all(row.figure and row.reason for row in rows)


@pytest.mark.parametrize(
    ("key", "change", "figure"),
    [
        ("b", {"rho3": {"min_mm": 50, "max_mm": 105}}, "14.7 mm"),
        ("c", {"rho3": {"min_mm": 50, "max_mm": 125}}, "up to 14.7 mm"),
        ("d", {"rho1": {"min_mm": 0, "max_mm": 391}}, "0.3 mm missing"),
        ("d", {"rho3": {"min_mm": 50, "max_mm": 68}}, "1.2 mm missing"),
        ("i", {"plug_diameter_mm": 71}, "71 mm"),
        ("k", {"base_width_mm": 1460, "e1x_mm": 45, "e2x_mm": -45}, "1505 x"),
        ("k", {"e_py_mm": -130}, "1350 x 207 mm"),
    ],
)
def test_what_is_not_met_says_by_which_figure(
    key: str, change: dict[str, Any], figure: str
) -> None:
    (row,) = (row for row in table(change) if row.key == key)
    assert row.outcome is NOT_MET
    assert figure in row.figure


def test_weak_motors_fail_the_forces() -> None:
    weak_slide = table(demands=Demands(limits=ActuatorLimits(rho3_n=82)))
    assert weak_slide[0].outcome is NOT_MET  # 80 N and the slide's own weight
    assert weak_slide[7].outcome is MET  # 70 N and a heavier cable
    weak_carriages = table(demands=Demands(limits=ActuatorLimits(rho1_n=50)))
    assert weak_carriages[0].outcome is NOT_MET
    assert weak_carriages[7].outcome is NOT_MET


def test_the_heaviest_cable_is_what_counts() -> None:
    whole = Demands(loads=Loads(cable_share=1.0))
    half = Demands(loads=Loads(cable_share=0.5))
    heavy, light = (table(demands=demands)[7].figure for demands in (whole, half))
    assert heavy != light


def test_a_box_out_of_reach_fails_and_does_not_raise() -> None:
    rows = {row.key: row for row in table({"regular_box": {"center_y_mm": 700}})}
    assert rows["a"].outcome is NOT_MET
    assert "the carriages" in rows["a"].reason
    assert rows["d"].outcome is NOT_MET
    assert rows["e"].outcome is NOT_MET


def test_no_accuracy_is_claimed_for_a_robot_nobody_computed() -> None:
    (row,) = (row for row in table({"leg_length_mm": 560}) if row.key == "f")
    assert row.outcome is OPEN
    assert row.figure == "-"
