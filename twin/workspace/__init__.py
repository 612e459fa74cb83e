"""Where the platform V, and with it the plug tip, can be: exact regions, maps and worst cases.

See README.md beside this file. Lengths are millimetres in the wall plane of the base frame.
"""

from twin.workspace.arc_polygon import ArcPolygon, Extent
from twin.workspace.boundary import Arc, Limit, Loop, Piece, Point, Segment
from twin.workspace.errors import (
    EmptyRegionError,
    EmptyWorkspaceError,
    InvalidRectangleError,
    RectangleOutsideError,
    SingularRectangleError,
    WorkspaceError,
)
from twin.workspace.largest import LargestRectangle, largest_rectangle, largest_rectangle_at
from twin.workspace.margins import Margin, StrokeMargins, fits, require_fit, stroke_margins
from twin.workspace.rectangle import Rectangle
from twin.workspace.regions import placement_region, reachable_region, usable_region

__all__ = [
    "Arc",
    "ArcPolygon",
    "EmptyRegionError",
    "EmptyWorkspaceError",
    "Extent",
    "InvalidRectangleError",
    "LargestRectangle",
    "Limit",
    "Loop",
    "Margin",
    "Piece",
    "Point",
    "Rectangle",
    "RectangleOutsideError",
    "Segment",
    "SingularRectangleError",
    "StrokeMargins",
    "WorkspaceError",
    "fits",
    "largest_rectangle",
    "largest_rectangle_at",
    "placement_region",
    "reachable_region",
    "require_fit",
    "stroke_margins",
    "usable_region",
]
