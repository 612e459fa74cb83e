"""Forces in the wall plane that the platform exerts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from twin.geometry import RobotGeometry
from twin.statics.loads import LoadCase, Loads, platform_push_n


@dataclass(frozen=True, slots=True)
class PlanarForce:
    """Force that the platform exerts on its surroundings, in the base frame [N].

    The component across the wall plane is borne by the guides and asks nothing of the carriages.
    """

    x_n: float = 0.0
    y_n: float = 0.0

    @classmethod
    def of_loads(cls, geometry: RobotGeometry, loads: Loads, case: LoadCase) -> Self:
        """What holding the robot's weight and working on the socket ask for.

        A force F along the insertion axis leaves F sin(theta) to the platform.
        """
        return cls(0.0, platform_push_n(geometry, loads, case))
