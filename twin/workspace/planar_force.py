"""Forces in the wall plane that the platform exerts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from twin.geometry import RobotGeometry

STANDARD_GRAVITY_M_S2 = 9.80665


@dataclass(frozen=True, slots=True)
class PlanarForce:
    """Force that the platform exerts on its surroundings, in the base frame [N].

    Forces add up. The component across the wall plane is borne by the guides and asks nothing of
    the carriages.
    """

    x_n: float = 0.0
    y_n: float = 0.0

    def __add__(self, other: PlanarForce) -> PlanarForce:
        return PlanarForce(self.x_n + other.x_n, self.y_n + other.y_n)

    @classmethod
    def insertion(cls, geometry: RobotGeometry, force_n: float) -> Self:
        """What pushing the plug along the insertion axis asks in the wall plane: sin(theta) of it.

        Negative forces pull, as in withdrawing.
        """
        _, axis_y, _ = geometry.insertion_axis
        return cls(0.0, force_n * axis_y)

    @classmethod
    def holding(cls, mass_kg: float) -> Self:
        """What holding a mass on the platform against gravity asks."""
        return cls(0.0, mass_kg * STANDARD_GRAVITY_M_S2)
