"""The QR label as it is printed: its module matrix and its picture."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import segno
from numpy.typing import NDArray

QUIET_ZONE_MODULES = 4
"""White margin that the QR standard (ISO/IEC 18004) asks for on every side."""


@lru_cache(maxsize=16)
def label_modules(payload: str) -> NDArray[np.bool_]:
    """Module matrix of a printed label: level Q, smallest version that fits, never micro.

    One fixed setting, so that the matrix of a label follows from its text alone.

    Returns:
        True is black, shape (n, n), row 0 the top row; read-only.

    Raises:
        ValueError: the text is empty or too long for a QR code.
    """
    if not payload:
        msg = "a label needs a text of at least one character"
        raise ValueError(msg)
    try:
        code = segno.make(payload, error="q", boost_error=False, micro=False)
    except segno.DataOverflowError as error:
        msg = f"{len(payload)} characters are too many for one QR code; shorten the text"
        raise ValueError(msg) from error
    modules = np.array(code.matrix, dtype=np.bool_)
    modules.flags.writeable = False  # it is shared through the cache
    return modules


def label_reflectance(
    modules: NDArray[np.bool_], texels_per_module: int, black: float, white: float
) -> NDArray[np.float32]:
    """Picture of the whole label with its quiet zone.

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
