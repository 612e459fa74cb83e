"""What is solved for, and how a look follows from it.

The platform only translates, so the camera keeps its attitude R = R_base_camera. With q the way
from the camera's zero to the label in the base frame (the label's place less the camera's place on
the platform: no motion tells the one from the other), V the platform and s the label's true size
over the entered one, the label is seen at

    o = R^T (q - V(rho)) / s.

Three choices of frame change no look and are fixed here: the left foot is where the drawing has
it, and the x axis is the mean direction of both rails. A fourth, the scale of everything, is held
by what is known beforehand: the label's printed size and the measured travel of the belts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry

Array = NDArray[np.float64]

WORDS = {
    "left_leg_mm": "The length of the left leg",
    "right_leg_mm": "The length of the right leg",
    "right_foot_x_mm": "The distance of the two carriages",
    "right_foot_y_mm": "The height of the right carriage over the left one",
    "half_skew_rad": "The angle between the two rails",
    "left_scale": "The travel of the left belt",
    "right_scale": "The travel of the right belt",
    "camera_x_rad": "The camera's tilt up or down",
    "camera_y_rad": "The camera's turn to a side",
    "camera_z_rad": "The camera's roll",
    "label_x_mm": "The label's place along the rail",
    "label_y_mm": "The label's height",
    "label_z_mm": "The label's distance",
    "label_ratio": "The label's size",
}
"""What the unknowns are called to people: seven of the mechanism, then camera, label and its size.
The camera is turned from its drawn attitude by a rotation vector in the base frame."""

NAMES = tuple(WORDS)
"""The unknowns in their order."""

MECHANISM = slice(0, 7)
_CAMERA, _LABEL, _RATIO = slice(7, 10), slice(10, 13), 13

_OF_BUILT = np.zeros((10, 7))
"""How the ten numbers of `PlanarAsBuilt` follow from the seven unknowns of the mechanism."""
for _row, _column, _share in (
    (0, 0, 1.0),
    (1, 1, 1.0),
    (4, 2, 1.0),
    (5, 3, 1.0),
    (6, 4, 1.0),
    (7, 4, -1.0),
    (8, 5, 1.0),
    (9, 6, 1.0),
):
    _OF_BUILT[_row, _column] = _share


@dataclass(frozen=True, slots=True, eq=False)
class Unknowns:
    """One guess.

    Attributes:
        drawn: Fixes the frame: where the left foot is.
        R_base_camera_drawn: Attitude of the camera as drawn, shape (3, 3).
        values: In the order of `NAMES`, shape (14,).
    """

    drawn: RobotGeometry
    R_base_camera_drawn: Array
    values: Array

    @classmethod
    def guess(
        cls,
        drawn: RobotGeometry,
        R_base_camera_drawn: Array,
        first_rho_mm: Array,
        first_label_mm: Array,
    ) -> Unknowns:
        """The drawing, and the label where the first look has it.

        Args:
            drawn: The robot as drawn.
            R_base_camera_drawn: Attitude of the camera as drawn, shape (3, 3).
            first_rho_mm: Carriages of a look, shape (2,) [mm].
            first_label_mm: What it saw, shape (3,) [mm].
        """
        built = PlanarAsBuilt.as_drawn(drawn)
        mechanism = [
            built.left_leg_mm,
            built.right_leg_mm,
            built.right_foot_x_mm,
            built.right_foot_y_mm,
            0.0,
            built.left_scale,
            built.right_scale,
        ]
        label = R_base_camera_drawn @ first_label_mm
        label[:2] += built.forward_many(first_rho_mm)
        values = np.concatenate((mechanism, np.zeros(3), label, [1.0]))
        return cls(drawn, R_base_camera_drawn, values)

    @property
    def built(self) -> PlanarAsBuilt:
        """The mechanism."""
        drawn = PlanarAsBuilt.as_drawn(self.drawn).vector
        fixed = np.where(_OF_BUILT.any(axis=1), 0.0, drawn)
        return PlanarAsBuilt.from_vector(fixed + _OF_BUILT @ self.values[MECHANISM])

    @property
    def R_base_camera(self) -> Array:  # noqa: N802 - a rotation names both frames
        """Attitude of the camera, shape (3, 3)."""
        return np.asarray(cv2.Rodrigues(self.values[_CAMERA])[0] @ self.R_base_camera_drawn)

    @property
    def label_ratio(self) -> float:
        """True size of the label over the entered one."""
        return float(self.values[_RATIO])

    def stepped(self, step: Array) -> Unknowns:
        """After a step of the solver: the camera turns by its part, the rest is added.

        Args:
            step: Shape (14,); the camera's part is a small rotation in the base frame.
        """
        values = self.values + step
        turned = cv2.Rodrigues(step[_CAMERA])[0] @ cv2.Rodrigues(self.values[_CAMERA])[0]
        values[_CAMERA] = _small_rotation_vector(np.asarray(turned))
        return Unknowns(self.drawn, self.R_base_camera_drawn, values)

    def predict(self, rho_mm: Array) -> Array:
        """Where the label would be seen, shape (n, 3) [mm], NaN where the legs cannot close."""
        return (self._way(rho_mm) @ self.R_base_camera) / self.label_ratio

    def derivatives(self, rho_mm: Array) -> Array:
        """How the prediction changes with each unknown, as `stepped` applies it.

        Args:
            rho_mm: Shape (n, 2) [mm].

        Returns:
            Shape (n, 3, 14).
        """
        way, built = self._way(rho_mm), self.built
        by_built = built.derivatives_many(rho_mm, built.forward_many(rho_mm))
        in_base = np.zeros((len(rho_mm), 3, len(NAMES)))
        in_base[:, :2, MECHANISM] = -by_built @ _OF_BUILT
        # R^T exp(-[w]) a = R^T (a - w x a) = R^T (a + a x w)
        for axis in range(3):
            unit = np.zeros(3)
            unit[axis] = 1.0
            in_base[:, :, 7 + axis] = np.cross(way, unit)
        in_base[:, :, _LABEL] = np.eye(3)
        found = np.einsum("ji,njk->nik", self.R_base_camera, in_base) / self.label_ratio
        found[:, :, _RATIO] = -self.predict(rho_mm) / self.label_ratio
        return np.asarray(found)

    def tip_derivatives(self, platform_mm: Array) -> Array:
        """How far the platform misses places when a number of the mechanism is wrong by 1.

        Args:
            platform_mm: Where it is sent, shape (n, 2) [mm].

        Returns:
            Shape (n, 2, 7).
        """
        rho_mm = self.built.inverse_many(platform_mm)
        return np.asarray(self.built.derivatives_many(rho_mm, platform_mm) @ _OF_BUILT)

    def _way(self, rho_mm: Array) -> Array:
        """From the camera to the label in the base frame, shape (n, 3) [mm]."""
        way = np.tile(self.values[_LABEL], (len(rho_mm), 1))
        way[:, :2] -= self.built.forward_many(rho_mm)
        return way


def mechanism_values(built: PlanarAsBuilt, drawn: RobotGeometry) -> Array:
    """A robot's seven numbers in the frame of the unknowns, shape (7,).

    Args:
        built: In a frame of its own.
        drawn: Says where the left foot is in that of the unknowns.
    """
    origin = PlanarAsBuilt.as_drawn(drawn)
    mean_rad = 0.5 * (built.left_rail_rad + built.right_rail_rad)
    to_x = np.array(
        [[math.cos(mean_rad), math.sin(mean_rad)], [-math.sin(mean_rad), math.cos(mean_rad)]]
    )
    between = to_x @ np.array(
        [
            built.right_foot_x_mm - built.left_foot_x_mm,
            built.right_foot_y_mm - built.left_foot_y_mm,
        ]
    )
    return np.array(
        [
            built.left_leg_mm,
            built.right_leg_mm,
            origin.left_foot_x_mm + between[0],
            origin.left_foot_y_mm + between[1],
            0.5 * (built.left_rail_rad - built.right_rail_rad),
            built.left_scale,
            built.right_scale,
        ]
    )


def _small_rotation_vector(rotation: Array) -> Array:
    """Rotation vector of a turn by less than 90 degrees, shape (3,).

    cv2.Rodrigues makes turns below 1e-5 rad to none, which a solver at its last step would feel.
    """
    doubled = np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    sine = 0.5 * float(np.linalg.norm(doubled))
    return np.asarray(0.5 * doubled * (math.asin(min(sine, 1.0)) / sine if sine else 1.0))
