"""The surfaces that the parts are made of, and the colours of the signals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

Rgb: TypeAlias = tuple[int, int, int]


@dataclass(frozen=True, slots=True)
class Material:
    """Physically based surface, as glTF's metallic-roughness model.

    Attributes:
        name: Unique name.
        color: Base colour, sRGB 0-255.
        metallic: 0 for plastic or paint, 1 for bare metal.
        roughness: 0 for a mirror, 1 for chalk.
        glow: Part of the base colour that is emitted whatever the light.
        opacity: 1 for what nothing is seen through.
        blend: Whether the alpha of vertex colours makes the surface transparent.
        texture_png: Picture laid over the surface by its texture coordinates.
    """

    name: str
    color: Rgb
    metallic: float = 0.0
    roughness: float = 0.6
    glow: float = 0.0
    opacity: float = 1.0
    blend: bool = False
    texture_png: bytes | None = None


ALUMINIUM = Material("aluminium", (196, 201, 207), metallic=0.85, roughness=0.34)
STEEL = Material("steel", (150, 155, 162), metallic=1.0, roughness=0.25)
ANTHRACITE = Material("anthracite", (44, 48, 54), metallic=0.35, roughness=0.5)
RUBBER = Material("rubber", (22, 23, 25), roughness=0.9)
PLASTIC = Material("plastic", (30, 32, 36), roughness=0.45)
SHELL = Material("shell", (236, 239, 241), roughness=0.38)
ACCENT = Material("accent", (0, 172, 150), metallic=0.1, roughness=0.4)
COPPER = Material("copper", (214, 150, 92), metallic=1.0, roughness=0.3)
LENS = Material("lens", (12, 20, 38), metallic=0.6, roughness=0.08)
PAINT = Material("paint", (48, 92, 128), metallic=0.4, roughness=0.34)
PAINT_FADING = replace(PAINT, name="fading paint", blend=True)
GLASS_FADING = Material("glass", (16, 20, 26), metallic=0.5, roughness=0.1, blend=True)
LAMP = Material("lamp", (236, 244, 255), roughness=0.3, glow=0.9)
FLOOR = Material("floor", (120, 126, 134), roughness=0.85, blend=True)
WALL = Material("wall", (168, 172, 178), roughness=0.95, blend=True)

GUESSED = Material("guessed car", (150, 158, 168), roughness=0.8, opacity=0.22)
AHEAD = Material("commanded plug", (255, 176, 32), roughness=0.5, glow=0.25, opacity=0.55)

IDLE: Rgb = (150, 158, 168)
PLUGGED: Rgb = (0, 190, 165)
CHARGING: Rgb = (52, 211, 90)
REGION: Rgb = (0, 190, 165)
REACH: Rgb = (110, 168, 255)
PLACEMENT: Rgb = (255, 176, 32)
SPREAD: Rgb = (255, 94, 200)
VIEW: Rgb = (110, 168, 255)
PULLING: Rgb = (90, 160, 255)
CABLE: Rgb = (26, 27, 30)
