"""The study of one robot: every figure of the report, from the exact geometry of the workspace."""

from __future__ import annotations

from twin.geometry import RobotGeometry
from twin.kinematics import UnreachableError, alpha
from twin.kinematics.alpha import PlatformPosition
from twin.statics import LoadCase
from twin.statics.loads import platform_push_n, slide_thrust_n
from twin.study import report
from twin.study.demands import Demands
from twin.study.paper_figures import deflection_figures, lame_figures, paper_conditions
from twin.study.requirements import check_requirements
from twin.workspace import (
    Arc,
    Measure,
    Piece,
    PlanarForce,
    Point,
    Rectangle,
    RectangleOutsideError,
    TipBox,
    WorkspaceError,
    deepest_box_at,
    largest_rectangle,
    placement_region,
    reachable_region,
    stroke_margins,
    tip_box_margins,
    worst_over,
)


def study(geometry: RobotGeometry, demands: Demands | None = None) -> report.StudyReport:
    """Everything about one robot.

    Args:
        geometry: The robot.
        demands: Its loads, the limits of its actuators, and how near a singularity it may go.

    Raises:
        EmptyWorkspaceError: the robot reaches no position; says what to change.
    """
    demands = demands or Demands()
    region = reachable_region(geometry)
    regular = Rectangle.of_box(geometry.regular_box)
    forces = _forces(geometry, regular, demands)
    return report.StudyReport(
        geometry=geometry,
        area_mm2=region.area_mm2,
        boundary=tuple(_piece(piece) for loop in region.loops for piece in loop),
        largest_square=_largest_square(geometry),
        regular_square=_regular_square(geometry, regular),
        placements=_placements(geometry, regular),
        worst_condition=_worst_condition(geometry, regular),
        largest_force=min(forces, key=lambda f: f.margin_n / f.limit_n, default=None),
        forces=forces,
        box=_box(geometry),
        lame=lame_figures(geometry, regular),
        paper=paper_conditions(geometry),
        deflection=deflection_figures(geometry, regular),
        requirements=check_requirements(geometry, demands),
    )


def _piece(piece: Piece) -> report.BoundaryPiece:
    arc = piece if isinstance(piece, Arc) else None
    return report.BoundaryPiece(
        limit=piece.limit,
        start_mm=piece.start,
        end_mm=piece.end,
        center_mm=arc.center if arc else None,
        radius_mm=arc.radius_mm if arc else None,
    )


def _largest_square(geometry: RobotGeometry) -> report.LargestSquare:
    found = largest_rectangle(geometry)
    square = found.rectangle
    return report.LargestSquare(
        side_mm=square.width_mm,
        center_mm=(square.center_x_mm, square.center_y_mm),
        contacts=found.contacts,
    )


def _regular_square(geometry: RobotGeometry, regular: Rectangle) -> report.RegularSquare:
    margins = stroke_margins(geometry, regular)
    return report.RegularSquare(
        side_mm=report.side_mm(regular),
        width_mm=regular.width_mm,
        height_mm=regular.height_mm,
        center_mm=(regular.center_x_mm, regular.center_y_mm),
        fits=margins.fits,
        margins_mm=report.StrokeMarginsMm.of(margins),
        above_folded_mm=margins.assembly_side.value_mm,
        below_upright_mm=margins.leg_length.value_mm,
        corners=tuple(_corner(geometry, corner) for corner in regular.corners),
    )


def _corner(geometry: RobotGeometry, corner: Point) -> report.Corner:
    try:
        rho1, rho2 = alpha.inverse(geometry, PlatformPosition(*corner))
    except UnreachableError:
        return report.Corner(position_mm=corner, rho1_mm=None, rho2_mm=None, margins_mm=None)
    return report.Corner(
        position_mm=corner,
        rho1_mm=rho1,
        rho2_mm=rho2,
        margins_mm=report.StrokeMarginsMm(
            rho1_min=rho1 - geometry.rho1.min_mm,
            rho1_max=geometry.rho1.max_mm - rho1,
            rho2_min=rho2 - geometry.rho2.min_mm,
            rho2_max=geometry.rho2.max_mm - rho2,
        ),
    )


def _placements(geometry: RobotGeometry, regular: Rectangle) -> report.Placements:
    centers = placement_region(geometry, regular.width_mm, regular.height_mm)
    # a placement region has one loop at most: see twin.workspace.regions
    outline = centers.polylines()[0].tolist() if not centers.is_empty else []
    return report.Placements(
        side_mm=report.side_mm(regular),
        width_mm=regular.width_mm,
        height_mm=regular.height_mm,
        area_mm2=centers.area_mm2,
        boundary=tuple((x, y) for x, y in outline),
    )


def _worst_condition(geometry: RobotGeometry, regular: Rectangle) -> report.AtPlace | None:
    try:
        worst = worst_over(geometry, regular, Measure.CONDITION).greatest
    except WorkspaceError:
        return None
    return report.AtPlace(value=worst.value, at_mm=worst.at)


def _forces(
    geometry: RobotGeometry, regular: Rectangle, demands: Demands
) -> tuple[report.ActuatorForce, ...]:
    """The largest force of each actuator in each case; of none if the square is outside."""
    found = []
    for case in LoadCase:
        push = PlanarForce(0.0, platform_push_n(geometry, demands.loads, case))
        thrust_n = slide_thrust_n(geometry, demands.loads, case)
        measures = (("rho1", Measure.FORCE1), ("rho2", Measure.FORCE2))
        worst: list[tuple[str, float, Point | None]] = []
        try:
            for actuator, measure in measures:
                extremes = worst_over(geometry, regular, measure, push)
                largest = max(extremes.least, extremes.greatest, key=lambda e: abs(e.value))
                worst.append((actuator, largest.value, largest.at))
        except WorkspaceError:
            return ()
        worst.append(("rho3", thrust_n, None))
        for (actuator, force_n, at), limit_n in zip(worst, demands.limits.joints, strict=True):
            found.append(
                report.ActuatorForce(
                    case=case,
                    actuator=actuator,
                    force_n=force_n,
                    limit_n=limit_n,
                    margin_n=limit_n - abs(force_n),
                    at_mm=at,
                )
            )
    return tuple(found)


def _box(geometry: RobotGeometry) -> report.BoxReport:
    box = TipBox.regular(geometry)
    margins = tip_box_margins(geometry, box)
    try:
        deepest_mm: float | None = deepest_box_at(geometry, box).box.depth_mm
    except RectangleOutsideError:
        deepest_mm = None
    return report.BoxReport(
        width_mm=box.width_mm,
        height_mm=box.height_mm,
        depth_mm=box.depth_mm,
        tip_center_mm=box.center,
        fits=margins.fits,
        margins_mm=report.StrokeMarginsMm.of(margins.plane),
        rho3_min_mm=margins.rho3_min_mm,
        rho3_max_mm=margins.rho3_max_mm,
        deepest_mm=deepest_mm,
    )
