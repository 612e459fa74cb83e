"""How far the simulated robot sags under its own weight."""

from __future__ import annotations

from statistics import fmean

from drivers.simulator.interpolation import interpolated
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.statics import SagTables, sag


class RobotSag:
    """Sag straight down, against y.

    The whole platform sags by the deflection of alpha. The deflection of beta includes bending
    that does not depend on the slide and was there when the plug was taught, so only its
    difference from its mean moves the tip.

    Beyond the points of the published tables, and for a robot of other lengths, the nearest
    published value stands in: a real robot sags there too, and nothing better is known.

    Args:
        geometry: The robot as built.
        scale: Of the deflections in the tables; 0 for a rigid robot.
        tables: How far a robot of these lengths sags.
    """

    def __init__(self, geometry: RobotGeometry, scale: float, tables: SagTables) -> None:
        self._tables = tables
        self._geometry = geometry
        self._scale = scale
        mean_mm = fmean(tables.beta_mm)
        self._beta = tuple(
            (rho3_mm, scale * (beta_mm - mean_mm))
            for rho3_mm, beta_mm in zip(tables.beta_rho3_mm, tables.beta_mm, strict=True)
        )

    def of_platform_mm(self, rho1_mm: float, rho2_mm: float) -> float:
        """How far the platform hangs below its place [mm].

        Raises:
            LegsCannotCloseError: no pose has these joints.
        """
        joints = JointPosition(rho1_mm, rho2_mm, self._geometry.rho3.min_mm)
        return self._scale * sag(self._geometry, joints, self._tables).alpha_mm

    def of_tip_mm(self, rho3_mm: float) -> float:
        """How far the tip hangs below its place on the platform [mm]."""
        return interpolated(self._beta, rho3_mm)
