"""The front of a small electric car with its inlet, as meshes in the socket's upright frame.

The body is described level by level in a frame with the socket at its origin, x along the rail,
y up and z into the car. It fades out towards the rear: the robot only ever sees the front.
"""

from __future__ import annotations

import io
import math

import numpy as np
import segno

from twin.scene import plug_parts
from twin.scene.frames import rotation_x
from twin.scene.glb import Part
from twin.scene.materials import (
    ANTHRACITE,
    GLASS_FADING,
    GUESSED,
    LAMP,
    PAINT,
    PAINT_FADING,
    PLASTIC,
    RUBBER,
    SHELL,
    STEEL,
    Material,
)
from twin.scene.shapes import (
    Mesh,
    Points,
    circle,
    grid,
    lathe,
    loft,
    merged,
    plate,
    quad,
    rod,
    rounded_curve,
    rounded_rectangle,
)

PATCH_HALF_WIDTH, PATCH_HALF_HEIGHT = 190.0, 150.0
"""The flat part of the nose around the inlet, on the plane of the socket's face."""

WHEEL_RADIUS, WHEEL_WIDTH, WHEEL_X, WHEEL_Z = 305.0, 190.0, 765.0, 700.0
LABEL_EDGE, LABEL_QUIET = 60.0, 7.2

_SEAM = 1.5
_FADE_FROM_Z, _FADE_TO_Z = 920.0, 1850.0
_FRONT_TO_Y, _FRONT_TO_PART = 315.0, 0.993
"""Height and part of the half width up to which the body is opaque: none of it lies farther
back than where it begins to fade."""

# Height, foremost z and half width of each level; the nose's own tilt is added at the patch.
_LEVELS = np.array(
    [
        (-455.0, 60.0, 800.0),
        (-415.0, 0.0, 822.0),
        (-330.0, -44.0, 838.0),
        (-230.0, -42.0, 842.0),
        (-PATCH_HALF_HEIGHT, np.nan, 848.0),
        (0.0, np.nan, 850.0),
        (PATCH_HALF_HEIGHT, np.nan, 848.0),
        (205.0, 52.0, 842.0),
        (245.0, 100.0, 832.0),
        (278.0, 210.0, 818.0),
        (315.0, 430.0, 800.0),
        (350.0, 700.0, 778.0),
        (380.0, 930.0, 752.0),
    ]
)
_WINDOWS = np.array([(380.0, 930.0, 752.0), (540.0, 1120.0, 700.0), (665.0, 1290.0, 655.0)])
_ROOF = np.array([(665.0, 1290.0, 655.0), (720.0, 1400.0, 620.0), (752.0, 1650.0, 560.0)])

# Plan of every level: part of the half width, and how far it lies behind the foremost point.
_PLAN = np.array(
    [
        (0.0, 0.0),
        (PATCH_HALF_WIDTH / 850.0, 0.0),
        (0.38, 8.0),
        (0.54, 30.0),
        (0.68, 68.0),
        (0.8, 125.0),
        (0.885, 200.0),
        (0.94, 290.0),
        (0.975, 400.0),
        (0.993, 560.0),
        (1.0, 800.0),
        (1.0, 1200.0),
        (1.0, 1800.0),
    ]
)


def _levels(theta_rad: float, per_span: int = 2) -> Points:
    """The nose's levels on a smooth curve, those of the patch on the plane of the socket."""
    table = _LEVELS.copy()
    table[:, 1] = np.where(np.isnan(table[:, 1]), -table[:, 0] * math.tan(theta_rad), table[:, 1])
    smooth = rounded_curve(table, per_span)
    on_patch = np.abs(smooth[:, 0]) <= PATCH_HALF_HEIGHT
    smooth[on_patch, 1] = -smooth[on_patch, 0] * math.tan(theta_rad)
    return smooth


def _plan() -> Points:
    """The plan from the car's right to its left, flat across the patch."""
    return np.concatenate([_PLAN[:0:-1] * (-1, 1), _PLAN])


def _skin(levels: Points, plan: Points, *, outwards_mm: float = 0.0) -> Points:
    """Points of the body's surface for each level and each point of the plan, (R, C, 3)."""
    y, front, half = (levels[:, None, i] for i in range(3))
    x = plan[None, :, 0] * (half + outwards_mm)
    z = front - outwards_mm + plan[None, :, 1] * (1 - front / 3000)
    return np.stack([x, np.broadcast_to(y, x.shape), z], axis=-1)


def _surface(points: Points) -> Mesh:
    """A skin that faces the wall, its opacity falling smoothly from 1 to 0 along the car."""
    mirrored = points[:, ::-1]
    t = np.clip((_FADE_TO_Z - mirrored[..., 2]) / (_FADE_TO_Z - _FADE_FROM_Z), 0, 1)
    return grid(mirrored, np.asarray(t * t * (3 - 2 * t)))


def _nose(theta_rad: float, per_span: int = 2) -> tuple[Mesh, Mesh]:
    """The painted body without the rectangle of the patch: its opaque front, its fading rear.

    Transparent surfaces are not sorted against each other, so only what fades may be one. The
    two meet along straight lines of the body, as panels do: their shading does not run on.
    """
    levels, plan = _levels(theta_rad, per_span), _plan()
    low, high = (int(np.argmin(np.abs(levels[:, 0] - y))) for y in (-150.0, 150.0))
    left, right = (int(np.argmin(np.abs(plan[:, 0] - s * _PLAN[1, 0]))) for s in (-1, 1))
    skin = _skin(levels, plan)
    whole = _surface(skin)
    columns = len(plan)
    cells = np.ones((len(levels) - 1, columns - 1), dtype=bool)
    # The skin is mirrored, which swaps the sides of a symmetric hole.
    cells[low:high, columns - 1 - right : columns - 1 - left] = False
    reach = np.maximum(np.abs(plan[1:, 0]), np.abs(plan[:-1, 0]))
    near = np.outer(levels[1:, 0] <= _FRONT_TO_Y, reach <= _FRONT_TO_PART)
    front, rear = (np.tile((cells & part).ravel(), 2) for part in (near, ~near))
    return (
        Mesh(whole.vertices_mm, whole.faces[front]),
        Mesh(whole.vertices_mm, whole.faces[rear], alpha=whole.alpha),
    )


def _patch(theta_rad: float) -> Mesh:
    """The flat patch of the nose with a round hole for the inlet.

    It is a little larger than its place, so that no light shows through the seam.
    """
    w, h = PATCH_HALF_WIDTH + _SEAM, PATCH_HALF_HEIGHT + _SEAM
    corner = math.atan2(h, w)
    special = [corner, math.pi - corner, math.pi + corner, 2 * math.pi - corner]
    angles = np.sort(np.concatenate([np.arange(40) * math.pi / 20, special]))
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    reach = np.minimum(
        w / np.maximum(np.abs(directions[:, 0]), 1e-9),
        h / np.maximum(np.abs(directions[:, 1]), 1e-9),
    )
    outer, inner = directions * reach[:, None], directions * (plug_parts.CAVITY_RADIUS + 6.0)
    slope = -math.tan(theta_rad)
    rings = [np.column_stack([r, r[:, 1] * slope]) for r in (inner, outer)]
    return loft(rings, closed=False)


def _strip(theta_rad: float, y: tuple[float, float], part: tuple[float, float], out: float) -> Mesh:
    """A patch laid on the body between two heights and two parts of the half width."""
    known = _levels(theta_rad)
    heights = np.linspace(*y, 3)
    levels = np.column_stack(
        [heights, *(np.interp(heights, known[:, 0], known[:, i]) for i in (1, 2))]
    )
    across = np.linspace(*part, 24)
    plan = _plan()
    behind = np.interp(across, plan[:, 0], plan[:, 1])
    mesh = _surface(_skin(levels, np.column_stack([across, behind]), outwards_mm=out))
    return Mesh(mesh.vertices_mm, mesh.faces)


def _upright_to_socket(mesh: Mesh, theta_rad: float) -> Mesh:
    """From the level frame of the body to the tilted frame of the socket."""
    return mesh.turned(rotation_x(-theta_rad).T)


def body(theta_rad: float) -> list[Part]:
    """Painted body, glass, lamps and grille in the frame of a socket tilted by theta."""
    windows = _surface(_skin(rounded_curve(_WINDOWS, 1), _plan()))
    roof = _surface(_skin(rounded_curve(_ROOF, 1), _plan()))
    front, rear = _nose(theta_rad)
    parts: list[Part] = [(front, PAINT), (_patch(theta_rad), PAINT)]
    parts += [(rear, PAINT_FADING), (roof, PAINT_FADING), (windows, GLASS_FADING)]
    for side in (-1, 1):
        lamp = tuple(sorted((side * 0.52, side * 0.86)))
        parts.append((_strip(theta_rad, (168.0, 196.0), (lamp[0], lamp[1]), 9.0), LAMP))
        parts.append((_strip(theta_rad, (158.0, 206.0), (lamp[0], lamp[1]), 6.0), PLASTIC))
    parts.append((_strip(theta_rad, (179.0, 184.0), (-0.53, 0.53), 6.0), LAMP))
    parts.append((_strip(theta_rad, (-372.0, -285.0), (-0.56, 0.56), 8.0), ANTHRACITE))
    return [(_upright_to_socket(mesh, theta_rad), material) for mesh, material in parts]


def silhouette(theta_rad: float) -> list[Part]:
    """The front of the body alone: shown when the car's place is a guess."""
    front, _ = _nose(theta_rad, per_span=1)
    whole = merged([front, _patch(theta_rad)])
    return [(_upright_to_socket(whole, theta_rad), GUESSED)]


def inlet() -> list[Part]:
    """The socket and its open flap, in the socket's frame."""
    outwards = np.diag([-1.0, 1.0, -1.0])
    parts = [(mesh.turned(outwards), material) for mesh, material in plug_parts.socket()]
    flap = plate(rounded_rectangle(128.0, 128.0, 26.0), 7.0, chamfer_mm=2.5).moved((-64.0, 0, -3.5))
    c, s = math.cos(math.radians(98)), math.sin(math.radians(98))
    swing = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    hinge_x = -(plug_parts.CAVITY_RADIUS + 26.0)
    parts.append((flap.turned(swing.T).moved((hinge_x, 0, -10.0)), SHELL))
    arm = rod(5.0, 90.0).turned(rotation_x(-math.pi / 2)).moved((hinge_x, -45.0, -8.0))
    return [*parts, (arm, STEEL)]


def wheel() -> list[Part]:
    """One front wheel in its arch; origin its middle, x along the axle out of the car."""
    tyre = lathe(
        [
            (0.0, 20.0),
            (175.0, 24.0),
            (205.0, 4.0),
            (WHEEL_RADIUS - 26.0, 0.0),
            (WHEEL_RADIUS, 24.0),
            (WHEEL_RADIUS, WHEEL_WIDTH - 24.0),
            (WHEEL_RADIUS - 26.0, WHEEL_WIDTH),
            (0.0, WHEEL_WIDTH),
        ],
    )
    rim = plate(circle(186.0, 24), 12.0, chamfer_mm=5.0)
    opening = circle(WHEEL_RADIUS + 40.0, 28)
    opening[:, 1] = np.maximum(opening[:, 1], -110.0)
    arch = plate(opening, 3.0, chamfer_mm=1.0)
    hub = plate(circle(34.0, 12), 18.0, chamfer_mm=4.0)
    # The lathe's z axis becomes the wheel's axle.
    out = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    pieces: list[Part] = [
        (tyre.moved((0, 0, -WHEEL_WIDTH / 2)), RUBBER),
        (rim.moved((0, 0, WHEEL_WIDTH / 2 - 4)), STEEL),
        (hub.moved((0, 0, WHEEL_WIDTH / 2 + 2)), ANTHRACITE),
        (arch.moved((0, 0, WHEEL_WIDTH / 2 - 12)), PLASTIC),
    ]
    return [(mesh.turned(out), material) for mesh, material in pieces]


def label() -> list[Part]:
    """The QR label in its own frame: x right, y down, z into the car."""
    picture = io.BytesIO()
    code = segno.make("PLUGPILOT", version=2, error="q", boost_error=False, micro=False)
    code.save(picture, kind="png", scale=8, border=3)
    paper = Material("label", (255, 255, 255), roughness=0.7, texture_png=picture.getvalue())
    edge = LABEL_EDGE + 2 * LABEL_QUIET
    facing_out = rotation_x(math.pi)
    backing = plate(rounded_rectangle(edge + 8, edge + 8, 6.0), 1.6, chamfer_mm=0.5)
    return [
        (quad(edge, edge).moved((0, 0, 2.4)).turned(facing_out), paper),
        (backing.turned(facing_out), SHELL),
    ]
