"""Where the platform V, and with it the plug tip, can be: exact regions, maps and worst cases.

See README.md beside this file. Lengths are millimetres in the wall plane of the base frame.
"""

from twin.workspace.arc_polygon import ArcPolygon, Extent
from twin.workspace.boundary import Arc, Limit, Loop, Piece, Point, Segment
from twin.workspace.deepest import DeepestBox, deepest_box, deepest_box_at
from twin.workspace.ellipses import Ellipse, force_ellipse, velocity_ellipse
from twin.workspace.errors import (
    EmptyRegionError,
    EmptyWorkspaceError,
    InvalidGridError,
    InvalidRectangleError,
    RectangleOutsideError,
    SingularRectangleError,
    WorkspaceError,
)
from twin.workspace.lame import LameComparison, compare_with_lame, lame_margins
from twin.workspace.largest import LargestRectangle, largest_rectangle, largest_rectangle_at
from twin.workspace.maps import WorkspaceMaps, map_axes, workspace_maps
from twin.workspace.margins import Margin, StrokeMargins, fits, require_fit, stroke_margins
from twin.workspace.measures import Measure, measure_rows
from twin.workspace.paper_conditions import (
    OffsetConditions,
    PaperDiscs,
    offset_conditions,
    paper_discs,
    v_abscissa_of_b,
)
from twin.workspace.planar_force import PlanarForce
from twin.workspace.rectangle import Rectangle
from twin.workspace.regions import placement_region, reachable_region, usable_region
from twin.workspace.tip_space import (
    TipBox,
    TipBoxMargins,
    tip_box_margins,
    tip_depth_range,
    tip_slice,
    tip_volume_mm3,
)
from twin.workspace.worst import Extreme, Extremes, worst_over

__all__ = [
    "Arc",
    "ArcPolygon",
    "DeepestBox",
    "Ellipse",
    "EmptyRegionError",
    "EmptyWorkspaceError",
    "Extent",
    "Extreme",
    "Extremes",
    "InvalidGridError",
    "InvalidRectangleError",
    "LameComparison",
    "LargestRectangle",
    "Limit",
    "Loop",
    "Margin",
    "Measure",
    "OffsetConditions",
    "PaperDiscs",
    "Piece",
    "PlanarForce",
    "Point",
    "Rectangle",
    "RectangleOutsideError",
    "Segment",
    "SingularRectangleError",
    "StrokeMargins",
    "TipBox",
    "TipBoxMargins",
    "WorkspaceError",
    "WorkspaceMaps",
    "compare_with_lame",
    "deepest_box",
    "deepest_box_at",
    "fits",
    "force_ellipse",
    "lame_margins",
    "largest_rectangle",
    "largest_rectangle_at",
    "map_axes",
    "measure_rows",
    "offset_conditions",
    "paper_discs",
    "placement_region",
    "reachable_region",
    "require_fit",
    "stroke_margins",
    "tip_box_margins",
    "tip_depth_range",
    "tip_slice",
    "tip_volume_mm3",
    "usable_region",
    "v_abscissa_of_b",
    "velocity_ellipse",
    "workspace_maps",
    "worst_over",
]
