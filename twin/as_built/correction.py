"""The map between the joints of the drawn robot and those of the built one.

Both put the platform in the same place: a joint position of the drawing becomes a place of V by
the drawn kinematics, and that becomes the carriages of the built robot. The slide stays as it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twin.as_built.planar import PlanarAsBuilt
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity
from twin.kinematics import alpha

Array = NDArray[np.float64]

_DIFFERENCE_S = 1e-3
"""For velocities: the map is so smooth that a difference over this time is exact to 1e-6 mm/s."""


@dataclass(frozen=True, slots=True)
class JointCorrection:
    """Joints of the drawing to joints of the board, and back.

    Attributes:
        drawn: The robot that everybody plans with.
        built: The robot on the wall.
    """

    drawn: RobotGeometry
    built: PlanarAsBuilt

    def to_board_many(self, joints_mm: Array) -> Array:
        """What to command.

        Args:
            joints_mm: Of the drawing, shape (..., 3) [mm].

        Returns:
            For the board, shape (..., 3) [mm]; NaN where one of the two robots has no such pose.
        """
        v = alpha.forward_many(self.drawn, joints_mm[..., :2])
        return np.concatenate((self.built.inverse_many(v), joints_mm[..., 2:]), axis=-1)

    def from_board_many(self, joints_mm: Array) -> Array:
        """What was measured.

        Args:
            joints_mm: Of the board, shape (..., 3) [mm].

        Returns:
            Of the drawing, shape (..., 3) [mm]; NaN where one of the two has no such pose.
        """
        v = self.built.forward_many(joints_mm[..., :2])
        return np.concatenate((alpha.inverse_many(self.drawn, v), joints_mm[..., 2:]), axis=-1)

    def from_board(self, joints: JointPosition) -> JointPosition:
        """What one measured position is.

        Raises:
            KinematicsError: one of the two robots has no such pose.
        """
        v = self.built.forward(joints.rho1_mm, joints.rho2_mm)
        rho1_mm, rho2_mm = alpha.inverse(self.drawn, v)
        return JointPosition(rho1_mm, rho2_mm, joints.rho3_mm)

    def velocity_from_board(self, joints: JointPosition, velocity: JointVelocity) -> JointVelocity:
        """How fast the joints of the drawing move while those of the board are somewhere.

        Raises:
            KinematicsError: one of the two robots has no such pose.
        """
        ahead, behind = (
            self.from_board(
                JointPosition(*(q + t * v for q, v in zip(joints, velocity, strict=True)))
            )
            for t in (_DIFFERENCE_S, -_DIFFERENCE_S)
        )
        return JointVelocity(
            (ahead.rho1_mm - behind.rho1_mm) / (2 * _DIFFERENCE_S),
            (ahead.rho2_mm - behind.rho2_mm) / (2 * _DIFFERENCE_S),
            velocity[2],
        )

    def rates_many(self, joints_mm: Array) -> Array:
        """How fast the board's joints move for joints of the drawing: J_built^-1 J_drawn.

        Args:
            joints_mm: Of the drawing, shape (..., 3) [mm].

        Returns:
            Matrices, shape (..., 3, 3).
        """
        board = self.to_board_many(joints_mm)
        drawn = PlanarAsBuilt.as_drawn(self.drawn).jacobians_many(joints_mm[..., :2])
        built = self.built.jacobians_many(board[..., :2])
        rates = np.zeros((*joints_mm.shape[:-1], 3, 3))
        rates[..., :2, :2] = np.linalg.solve(built, drawn)
        rates[..., 2, 2] = 1.0
        return rates
