"""How sure the measured place of the socket is: the ellipsoid that holds it 19 times of 20.

InvalidCovarianceError   a matrix that is no covariance has no ellipsoid
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.errors import TwinError
from twin.scene.frames import METRES_PER_MM, Vector, metres, quaternion
from twin.scene.materials import SPREAD
from twin.scene.nodes import add_label, add_pivot, set_text, set_visible
from twin.scene.overlays import SPREAD as OVERLAY
from twin.scene.state import Pose, TwinState

CHI_SQUARE_95_3 = 7.814727903251179
"""95 % quantile of the chi-square distribution with 3 degrees of freedom."""

_DRAWN_AT_LEAST_MM = 12.0
_ENLARGEMENTS = (1, 2, 5, 10, 20, 50, 100)
_ROUNDING = 1e-9


class InvalidCovarianceError(TwinError):
    """A matrix that is no covariance has no ellipsoid."""

    code = "invalid_covariance"
    remedy = "Measure the socket anew; report the measurement if it happens again."


class Ellipsoid(NamedTuple):
    """Half axes [mm], longest first, and the rotation (3, 3) whose columns they lie along."""

    half_axes_mm: Vector
    rotation: NDArray[np.float64]


def ellipsoid_95(covariance_mm2: NDArray[np.float64]) -> Ellipsoid:
    """Where a normally distributed point lies with 95 % probability.

    The set {x: x^T C^-1 x <= q} with q the chi-square quantile for three degrees of freedom has
    the half axes sqrt(q lambda_i) along the eigenvectors of C.

    Args:
        covariance_mm2: Shape (3, 3).

    Raises:
        InvalidCovarianceError: the matrix is not symmetric, not finite, or has a negative
            variance in some direction.
    """
    c = np.asarray(covariance_mm2, dtype=float)
    size = float(np.abs(c).max()) if np.isfinite(c).all() else np.nan
    if not size >= 0 or np.abs(c - c.T).max() > _ROUNDING * size:
        msg = "the socket's covariance is not a symmetric matrix of finite numbers"
        raise InvalidCovarianceError(msg)
    variances, axes = np.linalg.eigh((c + c.T) / 2)
    if variances[0] < -_ROUNDING * size:
        msg = f"the socket's covariance has a negative variance ({variances[0]:.3g} mm^2)"
        raise InvalidCovarianceError(msg)
    longest, middle, shortest = np.sqrt(CHI_SQUARE_95_3 * np.maximum(variances[::-1], 0))
    rotation = axes[:, ::-1].copy()
    if np.linalg.det(rotation) < 0:
        rotation[:, 2] *= -1
    return Ellipsoid((float(longest), float(middle), float(shortest)), rotation)


def enlargement(half_axis_mm: float) -> int:
    """By how much an ellipsoid must be enlarged to be seen beside a socket."""
    for factor in _ENLARGEMENTS:
        if factor * half_axis_mm >= _DRAWN_AT_LEAST_MM:
            return factor
    return _ENLARGEMENTS[-1]


class SpreadNodes:
    """The ellipsoid about the socket; words say its true size and how much larger it is drawn."""

    def __init__(self, scene: SceneApi) -> None:
        name = OVERLAY.nodes[0]
        add_pivot(scene, name, visible=False)
        self.place = add_pivot(scene, f"{name}/place", visible=False)
        self.ellipsoid = scene.add_icosphere(
            f"{name}/place/ellipsoid",
            radius=METRES_PER_MM,
            color=SPREAD,
            subdivisions=3,
            opacity=0.5,
            cast_shadow=False,
            receive_shadow=False,
        )
        self.label = add_label(scene, f"{name}/place/size", "", at_mm=(0.0, 55.0, 0.0))
        self._drawn: tuple[Pose | None, NDArray[np.float64] | None] = (None, None)

    def show(self, state: TwinState) -> None:
        """Draws the newest measurement, once.

        Raises:
            InvalidCovarianceError: what was measured has no ellipsoid; nothing is shown.
        """
        newest = (state.T_base_socket, state.socket_covariance_mm2)
        if all(new is old for new, old in zip(newest, self._drawn, strict=True)):
            return
        try:
            known = self._draw(state.T_base_socket, state.socket_covariance_mm2)
        except InvalidCovarianceError:
            set_visible(self.place, visible=False)
            raise
        set_visible(self.place, visible=known)
        self._drawn = newest

    def _draw(self, T_base_socket: Pose | None, covariance_mm2: NDArray[np.float64] | None) -> bool:
        if T_base_socket is None or covariance_mm2 is None:
            return False
        half_axes, rotation = ellipsoid_95(covariance_mm2)
        factor = enlargement(half_axes[0])
        a, b, c = half_axes
        self.place.position = metres(T_base_socket[:3, 3])
        self.ellipsoid.wxyz = quaternion(rotation)
        self.ellipsoid.scale = (a * factor, b * factor, c * factor)
        drawn = "" if factor == 1 else f" (drawn {factor} x)"
        set_text(self.label, f"± {a:.2f}, {b:.2f}, {c:.2f} mm{drawn}")
        return True
