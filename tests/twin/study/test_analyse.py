from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.twin.strategies import between
from twin.geometry import JointRange, RegularBox, RobotGeometry
from twin.kinematics import alpha
from twin.kinematics.alpha import PlatformPosition
from twin.statics import LoadCase, SagValidity
from twin.study.analyse import study
from twin.study.report import StudyReport
from twin.workspace import EmptyWorkspaceError, Limit, reachable_region


def test_the_default_robot(default_report: StudyReport) -> None:
    report = default_report
    assert report.area_mm2 == pytest.approx(113_351.1446, abs=1e-3)
    assert report.largest_square.side_mm == pytest.approx(224.3879, abs=1e-4)
    assert report.largest_square.center_mm == pytest.approx((650, 335.6270), abs=1e-3)
    assert report.placements.area_mm2 == pytest.approx(1243.4696, abs=1e-3)
    square = report.regular_square
    assert square.fits
    assert square.side_mm == 200
    assert square.center_mm == pytest.approx((650, 335))
    # rho in [17.7, 388.7] of [0, 420]
    least = 470 + 25 - math.sqrt(532**2 - 235**2)
    greatest = 670 + 25 - math.sqrt(532**2 - 435**2)
    assert square.margins_mm.rho1_min == pytest.approx(least)
    assert square.margins_mm.rho2_min == pytest.approx(least)
    assert square.margins_mm.rho1_max == pytest.approx(420 - greatest)
    assert square.margins_mm.rho2_max == pytest.approx(420 - greatest)


def test_condition_and_forces_of_the_default_robot(default_report: StudyReport) -> None:
    # of a symmetric robot the condition number is max(d / h, h / d): here at the lowest row
    worst = default_report.worst_condition
    assert worst is not None
    assert worst.value == pytest.approx(math.sqrt(532**2 - 235**2) / 235)
    assert worst.at_mm[1] == pytest.approx(235)
    force = default_report.largest_force
    assert force is not None
    assert (force.case, force.actuator) == (LoadCase.WITHDRAWING, "rho1")
    weight_n = 4.15 * 9.80665 + 70 * math.sin(math.radians(10))
    assert force.force_n == pytest.approx(weight_n * worst.value / 2)
    assert force.margin_n == pytest.approx(100 - force.force_n)
    assert len(default_report.forces) == 9


def test_the_corners_are_where_the_margins_come_from(default_report: StudyReport) -> None:
    square = default_report.regular_square
    for name in ("rho1_min", "rho1_max", "rho2_min", "rho2_max"):
        at_corners = [getattr(corner.margins_mm, name) for corner in square.corners]
        assert min(at_corners) == pytest.approx(getattr(square.margins_mm, name))
    for corner in square.corners:
        rho = alpha.inverse(RobotGeometry(), PlatformPosition(*corner.position_mm))
        assert (corner.rho1_mm, corner.rho2_mm) == pytest.approx(rho)


def test_the_outline_of_the_placements_has_their_area(default_report: StudyReport) -> None:
    x, y = np.array(default_report.placements.boundary).T
    assert (x[0], y[0]) == (x[-1], y[-1])
    area = 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert area == pytest.approx(default_report.placements.area_mm2, rel=2e-3)


def test_the_box_leans_over_and_needs_a_little_more(default_report: StudyReport) -> None:
    box = default_report.box
    rise = 10 * math.tan(math.radians(10))
    lowest = 470 + 25 - math.sqrt(532**2 - (235 - rise) ** 2)
    assert box.fits
    assert box.margins_mm.rho1_min == pytest.approx(lowest)
    assert box.rho3_min_mm == pytest.approx(50 - 10 / math.cos(math.radians(10)))
    assert box.deepest_mm == pytest.approx(100 * math.cos(math.radians(10)))


def test_the_papers_square_and_what_it_asks_for(default_report: StudyReport) -> None:
    of_b, of_v = default_report.paper
    assert of_b.center_mm == pytest.approx((650, 335))
    assert of_b.e1x_max_mm == pytest.approx(-7.2829, abs=1e-4)
    assert of_b.e1x_plus_s1_min_mm == pytest.approx(363.7338, abs=1e-4)
    assert of_b.s1_min_mm == pytest.approx(371.0167, abs=1e-4)
    assert of_b.met
    assert of_v.center_mm == pytest.approx((570, 335))
    # read as V's abscissa it asks for e1x - e2x = -160 = -L3
    assert of_v.e1x_max_mm - of_v.e2x_max_mm == pytest.approx(-160)
    assert of_v.met is False


@pytest.mark.parametrize(
    ("e1x_mm", "s1_mm", "met"),
    [(-7.29, 380, True), (-7.27, 380, False), (-25, 388.74, True), (-25, 388.73, False)],
)
def test_the_papers_conditions_are_exact(e1x_mm: float, s1_mm: float, met: bool) -> None:
    robot = RobotGeometry(e1x_mm=e1x_mm, rho1=JointRange(min_mm=0, max_mm=s1_mm))
    report = study(robot)
    assert report.paper[0].met is met
    assert report.regular_square.fits is met


def test_another_robot_has_no_say_about_the_papers_square() -> None:
    report = study(RobotGeometry(leg_length_mm=540))
    assert all(reading.met is None for reading in report.paper)
    assert report.deflection is not None
    assert report.deflection.validity is SagValidity.ANOTHER_ROBOT


def test_the_lame_curve_promises_too_much(default_report: StudyReport) -> None:
    six, twelve = default_report.lame
    assert (six.exponent, twelve.exponent) == (6, 12)
    assert six.exact_side_mm < twelve.largest_side_mm < six.largest_side_mm
    assert six.overstated_mm == pytest.approx(24.246, abs=1e-2)
    assert twelve.overstated_mm == pytest.approx(11.885, abs=1e-2)
    # the same with strokes between what the curve and what the square needs: it is wrong
    short = study(RobotGeometry(rho1=JointRange(min_mm=0, max_mm=380)))
    assert all(curve.fits and not curve.exact_fits for curve in short.lame)


def test_a_square_outside_gets_no_invented_figures() -> None:
    report = study(RobotGeometry(regular_box=RegularBox(center_x_mm=900)))
    assert not report.regular_square.fits
    assert report.regular_square.margins_mm.rho2_min < 0
    assert report.worst_condition is None
    assert report.largest_force is None
    assert report.forces == ()
    assert report.deflection is None
    assert report.lame == ()
    assert report.box.deepest_mm is None


def test_a_rectangle_is_no_square() -> None:
    report = study(RobotGeometry(regular_box=RegularBox(height_mm=120)))
    assert report.regular_square.side_mm is None
    assert report.placements.side_mm is None
    assert report.lame == ()
    assert report.placements.area_mm2 > 1243


def test_the_report_is_plain_json(default_report: StudyReport) -> None:
    document = json.loads(default_report.model_dump_json())
    assert StudyReport.model_validate(document) == default_report
    assert document["boundary"][0]["limit"] == Limit.RHO2_MIN.value
    assert isinstance(document["placements"]["boundary"][0][0], float)
    schema = StudyReport.model_json_schema(mode="serialization")
    assert set(document) == set(schema["required"])


@st.composite
def robots(draw: st.DrawFn) -> RobotGeometry:
    """Any robot with any box."""
    base_mm = draw(between(600, 1600))
    try:
        return RobotGeometry.model_validate(
            {
                "leg_length_mm": draw(between(300, 800)),
                "base_width_mm": base_mm,
                "platform_width_mm": draw(between(60, 300)),
                "e1y_mm": draw(between(-80, 80)),
                "e_py_mm": draw(st.sampled_from([-80.0, 0.0, 80.0])),
                "rho1": {"min_mm": 0, "max_mm": draw(between(60, 700))},
                "regular_box": {
                    "center_x_mm": base_mm / 2,
                    "center_y_mm": draw(between(100, 700)),
                    "width_mm": draw(between(20, 300)),
                },
            }
        )
    except ValidationError:  # the lengths make no robot
        reject()


@settings(max_examples=25)
@given(robots())
def test_any_robot_with_a_workspace_has_a_report(robot: RobotGeometry) -> None:
    try:
        report = study(robot)
    except EmptyWorkspaceError:
        with pytest.raises(EmptyWorkspaceError):
            reachable_region(robot)
        return
    assert report.area_mm2 > 0
    assert 0 < report.largest_square.side_mm**2 <= report.area_mm2 * (1 + 1e-9)
    if report.regular_square.fits:
        assert report.placements.boundary
    assert StudyReport.model_validate_json(report.model_dump_json()).geometry == robot
