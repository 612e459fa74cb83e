"""What may be laid over the picture, and which nodes carry it.

Each overlay hangs on nodes whose visibility the server sets once and never again. So a page can
show or hide them for its own viewer alone; what comes and goes by itself (a path, a force) comes
and goes below them. This list is data only: reading it loads no 3D library.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Overlay:
    """One thing that a viewer can switch.

    Attributes:
        id: Stable name.
        title: Name for people.
        nodes: Nodes that carry it.
        shown_at_first: Whether a new viewer sees it.
    """

    id: str
    title: str
    nodes: tuple[str, ...]
    shown_at_first: bool = False


PATH = Overlay("path", "Planned path", ("/overlays/path",), shown_at_first=True)
GHOST = Overlay("ghost", "Commanded plug", ("/overlays/ghost",), shown_at_first=True)
TARGET = Overlay("target", "Chosen place", ("/overlays/target",), shown_at_first=True)
FORCES = Overlay(
    "forces",
    "Forces",
    (
        "/robot/platform/plug/forces",
        "/robot/left_carriage/forces",
        "/robot/right_carriage/forces",
    ),
    shown_at_first=True,
)
PULL = Overlay("pull", "Pull of the cable", ("/robot/platform/plug/pull",))
SPREAD = Overlay("spread", "Socket, 95 % certain", ("/overlays/spread",))
CAMERA = Overlay("camera", "Camera view", ("/robot/platform/camera/view",))
REGION = Overlay("region", "Reach", ("/overlays/region",))
BOX = Overlay("box", "Regular box", ("/overlays/box",))
PLACEMENTS = Overlay("placements", "Where the box fits", ("/overlays/placements",))
CONDITION = Overlay("condition", "Singularity map", ("/overlays/condition",))
SAG = Overlay("sag", "Sag at nine points", ("/overlays/sag",))

OVERLAYS = (
    PATH,
    GHOST,
    TARGET,
    FORCES,
    PULL,
    SPREAD,
    CAMERA,
    REGION,
    BOX,
    PLACEMENTS,
    CONDITION,
    SAG,
)
"""In the order in which people find them."""
