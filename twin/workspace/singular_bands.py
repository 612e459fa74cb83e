"""Heights of V that are far enough from the singularities of alpha, in closed form.

At a given height both legs are what they are wherever the platform stands along the rail, so all
measures of `twin.kinematics.singularity` depend on y alone. With h = y - e_y = L sin(phi):

- parallel: sin(phi1 + phi2) >= p from phi1 + phi2 = asin(p) to pi - asin(p); with e1y and e2y
  apart by 2 delta, the sum s belongs to y = (e1y + e2y)/2 + L sin(s/2) cos(g), where
  sin(g) = delta / (L cos(s/2));
- serial: cos(phi) >= q where |y - e_y| <= L sqrt(1 - q^2), for both legs;
- parallelogram: |sin(phi1 - psi)| >= r outside of psi +- asin(r), where tan(psi) =
  e_py / (L3/2); this may cut a stripe out of the middle.
"""

from __future__ import annotations

import math

from twin.geometry import RobotGeometry
from twin.kinematics import SingularityLimits
from twin.workspace.between import Band
from twin.workspace.boundary import Limit
from twin.workspace.leg_flanks import leg_band


def regular_bands(geometry: RobotGeometry, limits: SingularityLimits) -> list[Band]:
    """Disjoint bands of heights that keep all limits, ascending; none if no height does."""
    band = _clipped(leg_band(geometry), _serial_band(geometry, limits.serial))
    parallel = _parallel_band(geometry, limits.parallel)
    if parallel is None:
        return []
    bands = [_clipped(band, parallel)]
    for low_mm, high_mm in _flat_stripes(geometry, limits.parallelogram):
        bands = [
            part
            for whole in bands
            for part in (
                _clipped(whole, whole._replace(y_high_mm=low_mm, high_limit=Limit.PARALLELOGRAM)),
                _clipped(whole, whole._replace(y_low_mm=high_mm, low_limit=Limit.PARALLELOGRAM)),
            )
        ]
    return [band for band in bands if band.y_low_mm < band.y_high_mm]


def _clipped(one: Band, other: Band) -> Band:
    """What two bands have in common; low exceeds high if that is nothing."""
    low = max(one, other, key=lambda band: band.y_low_mm)
    high = min(one, other, key=lambda band: band.y_high_mm)
    return Band(low.y_low_mm, high.y_high_mm, low.low_limit, high.high_limit)


def _serial_band(geometry: RobotGeometry, least: float) -> Band:
    rise_mm = geometry.leg_length_mm * math.sqrt(1 - least * least)
    low_mm = max(geometry.e1y_mm, geometry.e2y_mm) - rise_mm
    high_mm = min(geometry.e1y_mm, geometry.e2y_mm) + rise_mm
    return Band(low_mm, high_mm, Limit.SERIAL, Limit.SERIAL)


def _parallel_band(geometry: RobotGeometry, least: float) -> Band | None:
    """Heights at which the legs are far enough from one line; None if they never are."""
    low_mm = _height_of_sum(geometry, math.asin(least))
    high_mm = _height_of_sum(geometry, math.pi - math.asin(least))
    if low_mm is None:
        return None
    return Band(low_mm, math.inf if high_mm is None else high_mm, Limit.PARALLEL, Limit.PARALLEL)


def _height_of_sum(geometry: RobotGeometry, sum_rad: float) -> float | None:
    """Height at which phi1 + phi2 has a value; None if one leg is upright before that."""
    delta_mm = 0.5 * abs(geometry.e1y_mm - geometry.e2y_mm)
    reach_mm = geometry.leg_length_mm * math.cos(0.5 * sum_rad)
    # the steeper leg leans by s/2 + g, which is upright where sin(g) = cos(s/2)
    if delta_mm > reach_mm * math.cos(0.5 * sum_rad):
        return None
    rise_mm = geometry.leg_length_mm * math.sin(0.5 * sum_rad)
    sine = delta_mm / reach_mm if reach_mm > 0 else 0.0
    return 0.5 * (geometry.e1y_mm + geometry.e2y_mm) + rise_mm * math.sqrt(1 - sine * sine)


def _flat_stripes(geometry: RobotGeometry, least: float) -> list[tuple[float, float]]:
    """Heights at which the parallelogram is too flat, as (low, high), ascending."""
    flat_rad = math.atan2(geometry.e_py_mm, 0.5 * geometry.platform_width_mm)
    margin_rad = math.asin(least)
    stripes = []
    for turn in (-1, 0, 1):
        ends = [flat_rad + turn * math.pi + away for away in (-margin_rad, margin_rad)]
        low, high = (min(max(angle, -0.5 * math.pi), 0.5 * math.pi) for angle in ends)
        if low < high:
            heights = [
                geometry.e1y_mm + geometry.leg_length_mm * math.sin(phi) for phi in (low, high)
            ]
            stripes.append((heights[0], heights[1]))
    return stripes
