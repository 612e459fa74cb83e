"""Meshes of the inclined slide, the plug it moves and the socket it goes into."""

from __future__ import annotations

import math

import numpy as np

from twin.scene.glb import Part
from twin.scene.materials import (
    ACCENT,
    AHEAD,
    ALUMINIUM,
    ANTHRACITE,
    COPPER,
    PLASTIC,
    RUBBER,
    SHELL,
    STEEL,
)
from twin.scene.shapes import (
    Mesh,
    Points,
    block,
    circle,
    disc,
    inset,
    lathe,
    loft,
    plate,
    rod,
    rounded_rectangle,
    sweep,
)

PLUG_RADIUS = 32.5
PLUG_LENGTH = 165.0
CAVITY_RADIUS = 36.0
CAVITY_DEPTH = 72.0
CABLE_RADIUS = 9.5

# Contacts of a Type 2 coupler (IEC 62196-2) as seen from the plug's face: x, y, radius.
CONTACTS = (
    (-8.5, 11.0, 2.6),
    (8.5, 11.0, 2.6),
    (-17.0, -1.0, 3.4),
    (0.0, -1.0, 3.4),
    (17.0, -1.0, 3.4),
    (-8.5, -14.5, 3.4),
    (8.5, -14.5, 3.4),
)

_CORNERS = 36
_CARRIER_S = -118.0
"""Where the carrier holds the plug, along the axis from the tip."""
_RAIL_DROP = -62.0
"""Height of the slide's rail below the plug's axis."""


def _type2(radius_mm: float) -> Points:
    """A circle with the flat top that keeps a Type 2 plug from turning, shape (N, 2)."""
    outline = circle(radius_mm, _CORNERS)
    outline[:, 1] = np.minimum(outline[:, 1], 0.74 * radius_mm)
    return outline


def _type2_body(sections: list[tuple[float, float]]) -> Mesh:
    """A skin over Type 2 outlines (radius, z)."""
    return loft([np.column_stack([_type2(r), np.full(_CORNERS, at)]) for r, at in sections])


def slide(bracket_z_mm: float, rho3_min_mm: float, rho3_max_mm: float) -> list[Part]:
    """The inclined guide with its screw and motor, in the slide's frame.

    Its origin is the plug tip at rho3 = 0, its z axis the insertion axis.

    Args:
        bracket_z_mm: Where the bracket meets the platform, along the slide's z axis.
        rho3_min_mm: Start of the stroke.
        rho3_max_mm: End of the stroke.
    """
    start = rho3_min_mm + _CARRIER_S - 44.0
    end = rho3_max_mm + _CARRIER_S + 34.0
    length, middle = end - start, (start + end) / 2
    bracket_length = start - bracket_z_mm + 26.0
    # Two cheeks, so that the cable can hang between them.
    cheek = block((12.0, 62.0, bracket_length), radius_mm=8.0)
    middle_z, height = bracket_z_mm + bracket_length / 2, _RAIL_DROP + 20.0
    return [
        *((cheek.moved((side, height, middle_z)), SHELL) for side in (-35.0, 35.0)),
        (block((58.0, 18.0, length), radius_mm=5.0).moved((0, _RAIL_DROP, middle)), ALUMINIUM),
        (rod(6.0, length).moved((0, _RAIL_DROP + 17.0, start)), STEEL),
        (block((60.0, 40.0, 10.0)).moved((0, _RAIL_DROP + 9.0, end - 2.0)), ANTHRACITE),
        (rod(13.0, 66.0, chamfer_mm=3.0).moved((0, _RAIL_DROP - 24.0, start)), ANTHRACITE),
        (rod(9.0, 12.0).moved((0, _RAIL_DROP - 24.0, start + 64.0)), STEEL),
    ]


def plug() -> list[Part]:
    """The plug with its carrier and the boot of its cable; origin the tip, z ahead."""
    collar = [(PLUG_RADIUS + 1.2, -74.0), (PLUG_RADIUS + 1.2, -67.0)]
    head = _type2_body([(29.5, -70.0), (29.5, -2.0), (27.5, 0.0)])
    shroud = _type2_body(
        [
            (24.0, -PLUG_LENGTH),
            (29.0, -PLUG_LENGTH + 14),
            (PLUG_RADIUS, -96.0),
            (PLUG_RADIUS, -66.0),
        ]
    )
    parts: list[Part] = [(head, PLASTIC), (shroud, PLASTIC), (_type2_body(collar), ACCENT)]
    for x_mm, y_mm, radius in CONTACTS:
        parts.append((disc(radius + 1.6, 1.2).moved((x_mm, y_mm, -0.6)), RUBBER))
        parts.append((disc(radius * 0.6, 1.4).moved((x_mm, y_mm, -0.6)), COPPER))
    clamp = rounded_rectangle(84.0, 78.0, 18.0)
    parts.append((plate(clamp, 30.0, chamfer_mm=4.0).moved((0, -3.0, _CARRIER_S - 15.0)), SHELL))
    foot = block((50.0, 26.0, 44.0), radius_mm=5.0)
    parts.append((foot.moved((0, _RAIL_DROP + 20.0, _CARRIER_S)), ANTHRACITE))
    parts.append((sweep(boot_path(), CABLE_RADIUS + 3.5), RUBBER))
    return parts


def boot_path() -> Points:
    """The bend of the cable behind the plug: a quarter circle down, in the plug's frame."""
    angles = np.linspace(0.0, math.pi / 2, 7)
    radius = 42.0
    back = -PLUG_LENGTH + 4.0 - radius * np.sin(angles)
    down = -radius * (1 - np.cos(angles))
    return np.column_stack([np.zeros(7), down, back])


def cable_outlet_mm() -> Points:
    """Where the hanging cable begins, in the plug's frame, shape (3,)."""
    return np.asarray(boot_path()[-1])


def outline_of_plug() -> list[Part]:
    """A plain silhouette of the plug for the picture of where it should be."""
    outline = _type2_body(
        [
            (24.0, -PLUG_LENGTH),
            (PLUG_RADIUS, -96.0),
            (PLUG_RADIUS, -66.0),
            (29.5, -64.0),
            (29.5, 0.0),
        ]
    )
    return [(outline, AHEAD)]


def socket() -> list[Part]:
    """The car's inlet seen from outside: origin the centre of its face, z out of the car."""
    bowl = lathe(
        [
            (CAVITY_RADIUS + 13.0, -4.0),
            (CAVITY_RADIUS + 13.0, 3.0),
            (CAVITY_RADIUS + 10.0, 6.0),
            (CAVITY_RADIUS, 0.0),
            (CAVITY_RADIUS, -CAVITY_DEPTH),
            (0.0, -CAVITY_DEPTH),
        ],
    )
    parts: list[Part] = [(bowl, PLASTIC)]
    insert = inset(_type2(CAVITY_RADIUS), 9.0)
    parts.append(
        (plate(insert, 40.0, chamfer_mm=2.0).moved((0, 0, -CAVITY_DEPTH - 14)), ANTHRACITE)
    )
    for x_mm, y_mm, radius in CONTACTS:
        at = (-x_mm, y_mm, -CAVITY_DEPTH + 24.0)
        parts.append((disc(radius, 16.0).moved(at), COPPER))
    return parts
