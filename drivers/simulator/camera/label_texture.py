"""The picture of a printed label."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from twin.qr_label import QUIET_ZONE_MODULES


def label_reflectance(
    modules: NDArray[np.bool_], texels_per_module: int, black: float, white: float
) -> NDArray[np.float32]:
    """Picture of the whole label with its quiet zone; every texel lies in one module.

    Args:
        modules: True is black, shape (n, n).
        texels_per_module: Picture elements along one module.
        black: Reflectance of the ink, 0 to 1.
        white: Reflectance of the label's ground, 0 to 1.

    Returns:
        Reflectance, shape (m, m) with m = (n + 8) texels_per_module.
    """
    framed = np.pad(modules, QUIET_ZONE_MODULES)
    texels = np.where(framed, np.float32(black), np.float32(white))
    return texels.repeat(texels_per_module, axis=0).repeat(texels_per_module, axis=1)
