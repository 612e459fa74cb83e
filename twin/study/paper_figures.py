"""What the paper says, beside the exact answer: conditions, Lame curves, deflections."""

from __future__ import annotations

from itertools import product

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import LegsCannotCloseError, alpha
from twin.kinematics.alpha import PlatformPosition
from twin.statics import SagValidity, sag
from twin.study import report
from twin.workspace import (
    OffsetConditions,
    Rectangle,
    RectangleOutsideError,
    compare_with_lame,
    offset_conditions,
    stroke_margins,
    v_abscissa_of_b,
)

PAPER_ROBOT = RobotGeometry(leg_length_mm=532, base_width_mm=1300, platform_width_mm=160)
"""L, L2 and L3 of the paper; what it leaves open is not read from here."""

PAPER_CENTER_MM = (570.0, 335.0)
PAPER_SIDE_MM = 200.0


def lame_figures(geometry: RobotGeometry, regular: Rectangle) -> tuple[report.LameReport, ...]:
    """The Lame curves in place of the regular square; none if it is no square or outside."""
    if report.side_mm(regular) is None:
        return ()
    try:
        compared = compare_with_lame(
            geometry, regular.center_x_mm, regular.center_y_mm, 0.5 * regular.width_mm
        )
    except RectangleOutsideError:
        return ()
    return tuple(
        report.LameReport(
            exponent=found.exponent,
            margins_mm=report.StrokeMarginsMm.of(found.curve),
            fits=found.curve.fits,
            exact_fits=found.square.fits,
            largest_side_mm=2 * found.largest_curve_half_side_mm,
            exact_side_mm=2 * found.largest_square_half_side_mm,
            overstated_mm=2 * found.overstated_half_side_mm,
        )
        for found in compared
    )


def paper_conditions(geometry: RobotGeometry) -> tuple[report.PaperConditions, ...]:
    """The conditions on offsets and strokes, in both readings of the paper's centre."""
    x_mm, y_mm = PAPER_CENTER_MM
    readings = {
        "abscissa of B": v_abscissa_of_b(PAPER_ROBOT, x_mm),
        "abscissa of V": x_mm,
    }
    return tuple(_conditions(geometry, reading, v, y_mm) for reading, v in readings.items())


def _conditions(
    geometry: RobotGeometry, reading: str, x_mm: float, y_mm: float
) -> report.PaperConditions:
    square = Rectangle.square(x_mm, y_mm, PAPER_SIDE_MM)
    found = offset_conditions(PAPER_ROBOT, square, e_y_mm=0.0)
    return report.PaperConditions(
        reading=reading,
        center_mm=(x_mm, y_mm),
        e1x_max_mm=found.e1x_max_mm,
        e1x_plus_s1_min_mm=found.e1x_plus_s1_min_mm,
        e2x_max_mm=found.e2x_max_mm,
        e2x_plus_s2_min_mm=found.e2x_plus_s2_min_mm,
        s1_min_mm=found.s1_min_mm,
        s2_min_mm=found.s2_min_mm,
        met=_permits(found, geometry),
    )


def _permits(conditions: OffsetConditions, geometry: RobotGeometry) -> bool | None:
    """Whether a robot with the paper's lengths meets them; None for another robot."""
    for name in ("leg_length_mm", "base_width_mm", "platform_width_mm", "e1y_mm", "e2y_mm"):
        if getattr(geometry, name) != getattr(PAPER_ROBOT, name):
            return None
    # a stroke that does not start at 0 is an offset
    return conditions.permits(
        e1x_mm=geometry.e1x_mm + geometry.rho1.min_mm,
        s1_mm=geometry.rho1.stroke_mm,
        e2x_mm=geometry.e2x_mm + geometry.rho2.min_mm,
        s2_mm=geometry.rho2.stroke_mm,
    )


def deflection_figures(
    geometry: RobotGeometry, regular: Rectangle
) -> report.DeflectionReport | None:
    """The worst over corners, middles of edges and centre, at both ends and the middle of rho3."""
    if not stroke_margins(geometry, regular).fits:
        return None
    travel = geometry.rho3
    slides = (travel.min_mm, 0.5 * (travel.min_mm + travel.max_mm), travel.max_mm)
    columns = (regular.x_min_mm, regular.center_x_mm, regular.x_max_mm)
    rows = (regular.y_min_mm, regular.center_y_mm, regular.y_max_mm)
    try:
        found = [
            sag(geometry, JointPosition(*alpha.inverse(geometry, PlatformPosition(x, y)), rho3))
            for x, y, rho3 in product(columns, rows, slides)
        ]
    except LegsCannotCloseError:
        return None  # the square touches a singularity
    validities = [one.validity for one in found]
    return report.DeflectionReport(
        alpha_mm=max(one.alpha_mm for one in found),
        beta_mm=max(one.beta_mm for one in found),
        validity=max(validities, key=list(SagValidity).index),
    )
