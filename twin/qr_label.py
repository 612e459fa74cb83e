"""The QR label beside the socket: which modules of it are black."""

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
