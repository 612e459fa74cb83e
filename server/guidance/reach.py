"""How well a socket stands for the robot: the whole way of the plug against the exact reach.

The plug goes in by rho3 alone, so V stands at one point from before the socket until the plug is
seated: V must be in the region, and rho3 must have the way before the face and behind it. What V
may be is exact: ``placement_region`` gives the centres of all squares of twice the margin that lie
wholly in reach, and the regular box, a margin smaller all around, is cut with it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from server.config.guidance import GuidanceSettings
from server.config.insertion import InsertionSettings
from server.guidance.model import Array
from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import gamma
from twin.workspace import ArcPolygon, placement_region, reachable_region

_SLICES = 5
_LEAST_SIZE_MM = 1e-3


@dataclass(frozen=True, slots=True)
class Interval:
    """From low to high [mm]."""

    low_mm: float
    high_mm: float

    @property
    def middle_mm(self) -> float:
        """Halfway."""
        return 0.5 * (self.low_mm + self.high_mm)

    def margin_mm(self, value_mm: float) -> float:
        """Distance to the nearer end, negative outside."""
        return min(value_mm - self.low_mm, self.high_mm - value_mm)

    def way_mm(self, value_mm: float) -> float:
        """How far the value must go to be inside; 0 if it is."""
        return min(max(value_mm, self.low_mm), self.high_mm) - value_mm

    def shrunk(self, by_mm: float) -> Interval:
        """Smaller at both ends; the middle alone when nothing is left."""
        by_mm = min(by_mm, 0.5 * (self.high_mm - self.low_mm))
        return Interval(self.low_mm + by_mm, self.high_mm - by_mm)


@dataclass(frozen=True, slots=True)
class Zone:
    """Places of the socket from which the whole insertion is possible.

    Attributes:
        region: Of V.
        across: Further bounds of V along the rail, if any.
        upward: Heights of V at which the region has points.
        depth: Z of the socket's face.
    """

    region: ArcPolygon
    across: Interval | None
    upward: Interval
    depth: Interval

    def rail_at(self, v_y_mm: float) -> Interval:
        """Along the rail at a height of V, or at the nearest height that has points."""
        height_mm = min(max(v_y_mm, self.upward.low_mm), self.upward.high_mm)
        chord = self.region.chord(height_mm)
        if chord is None:  # the last rounding of the height
            chord = self.region.chord(self.upward.middle_mm) or (0.0, 0.0)
        low, high = chord
        if self.across is not None:
            low, high = max(low, self.across.low_mm), min(high, self.across.high_mm)
        return Interval(low, max(low, high))


@dataclass(frozen=True, slots=True)
class Standing:
    """A socket against one zone.

    Attributes:
        margin_mm: Smallest distance to an edge, its uncertainty taken off; negative outside.
        to_x_mm: The way along the rail into the zone, 0 if it is in it.
        to_y_mm: The same upwards.
        to_z_mm: The same out of the wall.
    """

    margin_mm: float
    to_x_mm: float
    to_y_mm: float
    to_z_mm: float


class Reach:
    """Knows where a socket may be.

    Args:
        geometry: Of the robot.
        insertion: The way of the plug before and behind the face.
        guidance: Margins.
    """

    def __init__(
        self, geometry: RobotGeometry, insertion: InsertionSettings, guidance: GuidanceSettings
    ) -> None:
        self._geometry = geometry
        self._certainty = guidance.certainty
        travel = geometry.rho3
        slide = Interval(
            travel.min_mm + insertion.pre_insertion_distance_mm,
            travel.max_mm - insertion.depth_mm,
        )
        self.reachable = _zone(geometry, reachable_region(geometry), slide)
        box, margin = geometry.regular_box, guidance.margin_mm
        across = Interval(
            box.center_x_mm - box.width_mm / 2, box.center_x_mm + box.width_mm / 2
        ).shrunk(margin)
        upward = Interval(
            box.center_y_mm - box.height_mm / 2, box.center_y_mm + box.height_mm / 2
        ).shrunk(margin)
        size_mm = max(2 * margin, _LEAST_SIZE_MM)
        region = placement_region(geometry, size_mm, size_mm)
        slide = slide.shrunk(guidance.depth_margin_mm)
        # a robot whose reach has nowhere that much to spare has nothing better than its reach
        self.good = (
            self.reachable
            if region.is_empty
            else _zone(geometry, region, slide, across=across, upward=upward)
        )

    @property
    def stop_z_mm(self) -> float:
        """The best place of the socket's face, from the wall."""
        return self.good.depth.middle_mm

    @property
    def middle_y_mm(self) -> float:
        """Height of a socket for which V stands in the middle of the good zone."""
        slide_mm = (self.stop_z_mm + self._geometry.e4z_mm - self._geometry.e3z_mm) / math.cos(
            self._geometry.theta_rad
        )
        rise_mm = gamma.tip_offset(self._geometry, slide_mm)[0]
        return self.good.upward.middle_mm + rise_mm

    def standing(self, zone: Zone, place_mm: Array, covariance_mm2: Array) -> Standing:
        """Compare a socket with a zone.

        Args:
            zone: ``good`` or ``reachable``.
            place_mm: The socket's origin in the base frame, shape (3,).
            covariance_mm2: Of the place, shape (3, 3).
        """
        x_mm, y_mm, z_mm = (float(value) for value in place_mm)
        z_in_mm = z_mm + zone.depth.way_mm(z_mm)  # V's height where the car will have to stand
        v_y_mm = self._platform_y_mm(y_mm, z_in_mm)
        rail = zone.rail_at(v_y_mm)
        slope = np.array([0.0, 1.0, -math.tan(self._geometry.theta_rad)])
        sigma_y = math.sqrt(max(0.0, float(slope @ covariance_mm2 @ slope)))
        sigma_x, _, sigma_z = np.sqrt(np.maximum(np.diag(covariance_mm2), 0.0)).tolist()
        margins = (
            rail.margin_mm(x_mm) - self._certainty * sigma_x,
            zone.upward.margin_mm(v_y_mm) - self._certainty * sigma_y,
            zone.depth.margin_mm(z_mm) - self._certainty * sigma_z,
        )
        return Standing(
            min(margins), rail.way_mm(x_mm), zone.upward.way_mm(v_y_mm), zone.depth.way_mm(z_mm)
        )

    def outline(self, zone: Zone, socket_y_mm: float) -> list[tuple[float, float]]:
        """The zone from above, (x, z) of the socket at a height, counter-clockwise [mm]."""
        depths = np.linspace(zone.depth.low_mm, zone.depth.high_mm, _SLICES).tolist()
        rails = [zone.rail_at(self._platform_y_mm(socket_y_mm, z)) for z in depths]
        left = [(rail.low_mm, z) for rail, z in zip(rails, depths, strict=True)]
        right = [(rail.high_mm, z) for rail, z in zip(rails, depths, strict=True)]
        return [*left, *reversed(right)]

    def _platform_y_mm(self, y_mm: float, z_mm: float) -> float:
        return gamma.platform_for_tip(self._geometry, TipPosition(0.0, y_mm, z_mm))[0].y_mm


def _zone(
    geometry: RobotGeometry,
    region: ArcPolygon,
    slide: Interval,
    *,
    across: Interval | None = None,
    upward: Interval | None = None,
) -> Zone:
    extent = region.extent
    low, high = extent.y_min_mm, extent.y_max_mm
    if upward is not None:
        low, high = max(low, upward.low_mm), min(high, upward.high_mm)
    depth = Interval(
        gamma.tip_offset(geometry, slide.low_mm)[1], gamma.tip_offset(geometry, slide.high_mm)[1]
    )
    return Zone(region, across, Interval(low, max(low, high)), depth)
