"""What all looks share that is neither the robot nor chance: label, lens and weight.

A label that bulges by a tenth of a millimetre, or is printed higher than wide, looks larger from
one side than from the other, and its distance is read off its size: wrong along the line of sight
by one smooth law for all looks, while the direction in which it is seen stays right to a
micrometre. A picture whose centre is elsewhere than believed is no turned camera, but nearly so.
And the platform hangs lower in one place than in another by some hundredths. Taken for chance, 25
looks would seem to average all that away, and it would turn and bend the robot instead.

So it is solved for together with the robot, each number about zero with a standard deviation:

    seen = predicted + d (a . (t_x, t_y, t_x^2, t_x t_y, t_y^2)) + z (c_x, c_y, 0)
           + R^T y (b . h(V)),

d the line of sight, t its slopes in the camera frame, z the distance, c the centre's error over the
focal length, and h the shares of nine places of the box, linear between them and constant beyond.
A wrong focal length changes distances only, all by one factor: that goes to the label's place.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RegularBox

Array = NDArray[np.float64]

SAG_SIGMA_MM = 0.02
"""Of the sag about its mean over the box, by the published tables."""
_SLOPE_SIGMA_MM, _CURVE_SIGMA_MM = 0.3, 0.5
"""Of a label 60 mm wide and 0.1 mm off its plane, from 0.3 m: 0.1 mm / 60 mm of that distance for
a slope of 1, and as much again for its square."""
_KNOTS = 3

EFFECTS = 5 + 2 + _KNOTS**2


def effect_sigmas(lens_sigma_rad: float) -> Array:
    """Standard deviation of each effect before the first look, shape (16,) [mm; of the lens rad].

    Args:
        lens_sigma_rad: Of the picture's centre, over the focal length.
    """
    of_label = (*(_SLOPE_SIGMA_MM,) * 2, *(_CURVE_SIGMA_MM,) * 3)
    return np.array([*of_label, *(lens_sigma_rad,) * 2, *(SAG_SIGMA_MM,) * _KNOTS**2])


def common_effects(
    label_mm: Array, platform_mm: Array, R_base_camera: Array, box: RegularBox
) -> Array:
    """How each effect shifts what is seen.

    Args:
        label_mm: Middle of the label in the camera frame, shape (n, 3) [mm].
        platform_mm: Where the platform stands, shape (n, 2) [mm].
        R_base_camera: How the camera is turned, shape (3, 3).
        box: In which the sag differs from place to place.

    Returns:
        Shape (n, 3, 16), camera frame.
    """
    x, y = (label_mm[:, :2] / label_mm[:, 2:]).T
    laws = np.column_stack((x, y, x * x, x * y, y * y))
    farther = lines_of_sight(label_mm)[:, :, None] * laws[:, None, :]
    # a platform that hangs lower sees the label higher
    higher = R_base_camera[1][None, :, None] * _shares(platform_mm, box)[:, None, :]
    beside = label_mm[:, 2, None, None] * np.eye(3)[None, :, :2]
    return np.concatenate((farther, beside, higher), axis=2)


def lines_of_sight(label_mm: Array) -> Array:
    """Unit vectors to places in the camera frame, shape (n, 3)."""
    return np.asarray(label_mm / np.linalg.norm(label_mm, axis=1, keepdims=True))


def _shares(platform_mm: Array, box: RegularBox) -> Array:
    """Share of each of the nine places, shape (n, 9)."""
    steps = np.linspace(-0.5, 0.5, _KNOTS)
    along = _shares_along(platform_mm[:, 0], box.center_x_mm + steps * box.width_mm)
    up = _shares_along(platform_mm[:, 1], box.center_y_mm + steps * box.height_mm)
    return np.asarray(np.einsum("ni,nj->nij", up, along).reshape(len(platform_mm), -1))


def _shares_along(values_mm: Array, knots_mm: Array) -> Array:
    return np.column_stack([np.interp(values_mm, knots_mm, one) for one in np.eye(len(knots_mm))])
