"""The sets of positions of V: all that are reached, and where a rectangle of them fits.

Both are one loop at most. Let a rectangle have half sizes w and h; then at a height y its centre
may be between a left and a right flank whose distance is the least of four: the joint limits taken
in pairs. Each pair is kept on an interval of y: those of one carriage because the drop of a half
circle over the window 2 h grows away from its middle; those of both because d1 + d2 is concave and
falls from the assembly side on, and so do its sliding maximum and minimum. Limits of singularity
can cut the set into several loops.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from twin.geometry import RobotGeometry
from twin.kinematics import SingularityLimits
from twin.workspace.arc_polygon import ArcPolygon
from twin.workspace.between import Band, region_between
from twin.workspace.errors import EmptyWorkspaceError
from twin.workspace.leg_flanks import foot_abscissae, leg_band, leg_flanks
from twin.workspace.rectangle import check_sizes
from twin.workspace.singular_bands import regular_bands


def reachable_region(geometry: RobotGeometry) -> ArcPolygon:
    """All positions of V that have joint positions within their limits.

    The same set as `twin.kinematics.alpha.inverse` with the travels of rho1 and rho2.

    Raises:
        EmptyWorkspaceError: there are none; the sentence says why.
    """
    region = region_between(*leg_flanks(geometry), [leg_band(geometry)])
    if region.is_empty:
        raise _why_empty(geometry)
    return region


def usable_region(geometry: RobotGeometry, limits: SingularityLimits) -> ArcPolygon:
    """The reachable positions far enough from all singularities; may be empty.

    The same set as `twin.kinematics.singularity.check` accepts.
    """
    return region_between(*leg_flanks(geometry), regular_bands(geometry, limits))


def placement_region(
    geometry: RobotGeometry,
    width_mm: float,
    height_mm: float,
    limits: SingularityLimits | None = None,
) -> ArcPolygon:
    """All centres whose rectangle lies wholly in the reachable, or usable, region; may be empty.

    Args:
        geometry: The robot.
        width_mm: Size of the rectangle along x.
        height_mm: Size of the rectangle along y.
        limits: With them the rectangle must also be far enough from all singularities.

    Raises:
        InvalidRectangleError: a size is not finite or not greater than zero.
    """
    check_sizes(width_mm, height_mm)
    half_height_mm = 0.5 * height_mm
    bands = [leg_band(geometry)] if limits is None else regular_bands(geometry, limits)
    flanks = leg_flanks(geometry, 0.5 * width_mm, half_height_mm)
    return region_between(*flanks, _narrowed(bands, half_height_mm))


def _narrowed(bands: Sequence[Band], by_mm: float) -> list[Band]:
    return [
        band._replace(y_low_mm=band.y_low_mm + by_mm, y_high_mm=band.y_high_mm - by_mm)
        for band in bands
    ]


def _why_empty(geometry: RobotGeometry) -> EmptyWorkspaceError:
    """Which of the conditions between the two legs cannot be met."""
    band = leg_band(geometry)
    length_mm, rise_mm = geometry.leg_length_mm, abs(geometry.e1y_mm - geometry.e2y_mm)
    if band.y_low_mm >= band.y_high_mm:
        return EmptyWorkspaceError(
            f"the carriages run {rise_mm:g} mm apart in height, and two legs of {length_mm:g} mm "
            "cannot bridge that",
            {"reason": "carriages_too_far_in_height", "rise_mm": rise_mm},
        )
    a, b = foot_abscissae(geometry)
    nearest_mm = b - a - geometry.rho1.max_mm - geometry.rho2.max_mm
    bridged_mm = 2 * math.sqrt(length_mm**2 - 0.25 * rise_mm**2)
    if nearest_mm >= bridged_mm:
        return EmptyWorkspaceError(
            f"the legs are too short: their feet stay {nearest_mm:g} mm apart and the legs bridge "
            f"at most {bridged_mm:g} mm; lengthen leg_length_mm or the travels of rho1 and rho2",
            {"reason": "legs_too_short", "feet_mm": nearest_mm, "bridged_mm": bridged_mm},
        )
    widest_mm = b - a - geometry.rho1.min_mm - geometry.rho2.min_mm
    return EmptyWorkspaceError(
        f"the carriages cross: their feet come at most {widest_mm:g} mm apart, too near for both "
        "legs to lean inwards; lengthen base_width_mm or lower the least rho1 and rho2",
        {"reason": "carriages_cross", "feet_mm": widest_mm},
    )
