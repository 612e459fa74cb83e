"""Numbers that describe what is in front of the simulated camera besides a flawless label.

The defaults are this project's own estimate of an ordinary garage: a label that a person stuck
on by hand some months ago, a lamp at the ceiling, no rain.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Spread = Annotated[float, Field(ge=0, le=10, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
Brightness = Annotated[float, Field(ge=0, le=1000, allow_inf_nan=False)]
Place = Annotated[float, Field(ge=-1e5, le=1e5, allow_inf_nan=False)]


class _Group(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class LabelConditions(_Group):
    """The label itself: how it was printed, how it sticks, what has become of it.

    Standard deviations are of what the seed draws for each garage's label: what is left after
    its print was measured with callipers and it was stuck on a flat place with some care.
    """

    print_scale_std: Annotated[float, Field(ge=0, le=0.2)] = Field(
        0.0004, description="printed size over the size that is believed, minus 1"
    )
    print_stretch_std: Annotated[float, Field(ge=0, le=0.2)] = Field(
        0.0003, description="height over width, minus 1"
    )
    bow_std_mm: Spread = Field(
        0.1, description="height of the middle over the edges, about a random side's direction"
    )
    lifted_corner_std_mm: Spread = Field(0.1, description="one corner stands off by so much")
    grain_std: Share = Field(0.008, description="of the paper's reflectance")
    dirt: Share = Field(0.004, description="share of the label under specks and smears")
    covered: Share = Field(0.0, description="share of the code under mud, tape or a leaf")
    gloss: Brightness = Field(0.25, description="of the paper; car paint has 1")
    roughness_rad: Annotated[float, Field(gt=0, le=1)] = Field(
        0.14, description="smears reflections in the paper; a laminated label has 0.05"
    )


class LampConditions(_Group):
    """Lamps that shine on the car and are reflected in it.

    Brightness 1 lights the car as a normally lit garage does. Ambient light is another matter:
    see ``imaging.ambient``.
    """

    ceiling: Brightness = Field(0.5, description="brightness of its reflection in car paint")
    ceiling_mm: tuple[Place, Place, Place] = Field(
        (-250.0, -950.0, -900.0),
        description="its place from the socket: right, down, into the car, as the robot looks",
    )
    ceiling_radius_mm: Annotated[float, Field(gt=0, le=2000)] = 80.0
    own: Brightness = Field(0.0, description="the robot's own light, on its axis at 300 mm")
    own_mm: tuple[Place, Place, Place] = Field(
        (0.0, -90.0, 0.0), description="its place from the lens: right, down, forward"
    )
    own_radius_mm: Annotated[float, Field(gt=0, le=100)] = 6.0
    own_half_angle_rad: Annotated[float, Field(gt=0, le=1.5)] = Field(
        0.6, description="its light falls to half so far off its axis"
    )


class RainConditions(_Group):
    """Drops on the car and on the glass before the lens."""

    drops_per_dm2: Annotated[float, Field(ge=0, le=500)] = Field(
        0.0, description="on the car and the label"
    )
    drop_mm: Annotated[float, Field(gt=0, le=10)] = Field(2.5, description="their mean diameter")
    lens_drops: Annotated[int, Field(ge=0, le=200)] = Field(0, description="on the glass")
    lens_drop_mm: Annotated[float, Field(gt=0, le=10)] = 1.5
    glass_mm: Annotated[float, Field(gt=1, le=100)] = Field(12.0, description="glass to lens")


class Conditions(_Group):
    """All of them."""

    label: LabelConditions = LabelConditions()
    lamps: LampConditions = LampConditions()
    rain: RainConditions = RainConditions()


FLAWLESS = Conditions(
    label=LabelConditions(
        print_scale_std=0,
        print_stretch_std=0,
        bow_std_mm=0,
        lifted_corner_std_mm=0,
        grain_std=0,
        dirt=0,
    ),
    lamps=LampConditions(ceiling=0),
)
"""A flat, clean label of the right size, and no reflections."""
