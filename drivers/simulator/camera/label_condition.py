"""What has become of one label: size as printed, shape as stuck on."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.conditions import LabelConditions

Maps = NDArray[np.float32]

_ROUNDS = 2
_LIFTED_SHARE = 0.6  # of the half diagonal; the rest sticks


@dataclass(frozen=True, slots=True)
class LabelCondition:
    """One label, as drawn from its spread.

    Attributes:
        width_scale: True width over the width that is believed.
        height_scale: The same for the height.
        bow_mm: How far the middle stands off when two opposite edges stick; negative: the middle
            sticks and the edges stand off.
        bow_angle_rad: Direction across which it is bowed, from the label's x towards its y.
        lifted_mm: How far the lifted corner stands off.
        lifted_corner: Which one: signs of its x and y.
    """

    width_scale: float = 1.0
    height_scale: float = 1.0
    bow_mm: float = 0.0
    bow_angle_rad: float = 0.0
    lifted_mm: float = 0.0
    lifted_corner: tuple[int, int] = (1, 1)

    @property
    def flat(self) -> bool:
        """No part of it stands off."""
        return self.bow_mm == 0 and self.lifted_mm == 0

    def height_mm(self, x_mm: Maps, y_mm: Maps, half_mm: float) -> Maps:
        """How far the label stands off its plane, towards the camera.

        The bow is a parabola, bow (1 - (s / half)^2) with s across; the lifted corner rises with
        the square of the way along the diagonal, from where it no longer sticks.

        Args:
            x_mm: Places on the label.
            y_mm: The same.
            half_mm: Half the side of the label.
        """
        height = np.zeros_like(x_mm)
        if self.bow_mm:
            across = x_mm * np.float32(math.cos(self.bow_angle_rad) / half_mm)
            across += y_mm * np.float32(math.sin(self.bow_angle_rad) / half_mm)
            height += np.float32(self.bow_mm) * (1 - np.minimum(across * across, 1.5))
        if self.lifted_mm:
            sign_x, sign_y = self.lifted_corner
            along = (x_mm * np.float32(sign_x) + y_mm * np.float32(sign_y)) / np.float32(
                2 * half_mm
            )
            beyond = np.clip((along - (1 - _LIFTED_SHARE)) / _LIFTED_SHARE, 0, 1.1)
            height += np.float32(self.lifted_mm) * beyond * beyond
        return height

    def bend(
        self, x_mm: Maps, y_mm: Maps, half_mm: float, camera_mm: NDArray[np.float64]
    ) -> tuple[Maps, Maps]:
        """Where on the bent label the rays arrive that meet its plane at (x, y).

        A ray from the camera c to (x, y, 0) meets a surface at height h beside it, at
        x - h (x - c_x) / |c_z|; h is that of the place where it arrives, hence two rounds. The
        paper's own shortening (8/3 h^2 / side: 1 um for a bow of 0.15 mm) is left out.

        Args:
            x_mm: In the label's plane.
            y_mm: The same.
            half_mm: Half the side of the label.
            camera_mm: The camera in the label frame, shape (3,).
        """
        c_x, c_y, c_z = (np.float32(value) for value in camera_mm)
        slope_x, slope_y = (x_mm - c_x) / abs(c_z), (y_mm - c_y) / abs(c_z)
        bent_x, bent_y = x_mm, y_mm
        for _ in range(_ROUNDS):
            height = self.height_mm(bent_x, bent_y, half_mm)
            bent_x, bent_y = x_mm - height * slope_x, y_mm - height * slope_y
        return bent_x, bent_y


FLAT = LabelCondition()
"""Flat, and of the size that is believed."""


def drawn_condition(numbers: LabelConditions, rng: np.random.Generator) -> LabelCondition:
    """Draw one label from its spread.

    Args:
        numbers: The spread.
        rng: Decides.
    """
    scale = 1 + float(rng.normal(0.0, numbers.print_scale_std))
    stretch = 1 + float(rng.normal(0.0, numbers.print_stretch_std))
    return LabelCondition(
        width_scale=scale,
        height_scale=scale * stretch,
        bow_mm=float(rng.normal(0.0, numbers.bow_std_mm)),
        bow_angle_rad=float(rng.choice((0.0, math.pi / 2))),
        lifted_mm=abs(float(rng.normal(0.0, numbers.lifted_corner_std_mm))),
        lifted_corner=(int(rng.choice((-1, 1))), int(rng.choice((-1, 1)))),
    )
