"""Is there a label that cannot be read? Its corner squares are the last to become unrecognisable.

A finder pattern of a QR code is a black square ring of 7 modules around a white one of 5 and a
black core of 3: contours nested in each other with areas 49 : 25 : 9 about one centre. Two of them
18 modules apart, or 18 sqrt(2), belong to one code.
"""

from __future__ import annotations

import math
from itertools import combinations
from typing import NamedTuple

import cv2
import numpy as np

from server.vision.markers.code import Image

_AROUND_PX = 41  # of the threshold
_DARKER = 8
_NOISE_PX = 1.0
_MOST_CONTOURS = 20_000  # nothing but noise
_LEAST_SIDE_PX = 10.0
_WHOLE_TO_CORE, _HOLE_TO_CORE = (3.0, 9.5), (1.6, 4.6)
_SQUARE = 0.6
_APART_MODULES = ((14.0, 22.0), (21.0, 30.0))


class FinderPattern(NamedTuple):
    """One corner square of a code.

    Attributes:
        u_px: Its middle.
        v_px: Its middle.
        module_px: Size of a module.
    """

    u_px: float
    v_px: float
    module_px: float


def unread_module_px(image: Image) -> float | None:
    """Size of the modules of a code that seems to be there, read or not; None if there is none."""
    found = [
        0.5 * (one.module_px + other.module_px)
        for one, other in combinations(finder_patterns(image), 2)
        if _belong_together(one, other)
    ]
    return max(found, default=None)


def finder_patterns(image: Image) -> list[FinderPattern]:
    """All squares that look like corners of a code."""
    smooth = cv2.GaussianBlur(image, (0, 0), _NOISE_PX)  # or every grain would be a contour
    binary = cv2.adaptiveThreshold(
        smooth, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV, _AROUND_PX, _DARKER
    )
    contours, hierarchy = cv2.findContours(binary, cv2.RETR_TREE, cv2.CHAIN_APPROX_SIMPLE)
    patterns: list[FinderPattern] = []
    if len(contours) > _MOST_CONTOURS:
        return patterns
    for index, outer in enumerate(contours):
        hole = int(hierarchy[0][index][2])
        core = int(hierarchy[0][hole][2]) if hole >= 0 else -1
        if core < 0:
            continue
        pattern = _pattern(
            np.asarray(outer), np.asarray(contours[hole]), np.asarray(contours[core])
        )
        if pattern is not None:
            patterns.append(pattern)
    return patterns


def _pattern(
    outer: cv2.typing.MatLike, hole: cv2.typing.MatLike, core: cv2.typing.MatLike
) -> FinderPattern | None:
    (u, v), (width, height), _ = cv2.minAreaRect(outer)
    if min(width, height) < _LEAST_SIDE_PX or min(width, height) < _SQUARE * max(width, height):
        return None
    whole_area, hole_area, core_area = (cv2.contourArea(part) for part in (outer, hole, core))
    if core_area <= 0 or whole_area < _SQUARE * width * height:
        return None
    if not _WHOLE_TO_CORE[0] < whole_area / core_area < _WHOLE_TO_CORE[1]:
        return None
    if not _HOLE_TO_CORE[0] < hole_area / core_area < _HOLE_TO_CORE[1]:
        return None
    (core_u, core_v), *_ = cv2.minAreaRect(core)
    module_px = math.sqrt(width * height) / 7
    if math.hypot(core_u - u, core_v - v) > module_px:
        return None
    return FinderPattern(u, v, module_px)


def _belong_together(one: FinderPattern, other: FinderPattern) -> bool:
    if not 0.7 < one.module_px / other.module_px < 1.4:
        return False
    modules = math.hypot(one.u_px - other.u_px, one.v_px - other.v_px)
    modules /= 0.5 * (one.module_px + other.module_px)
    return any(low < modules < high for low, high in _APART_MODULES)
