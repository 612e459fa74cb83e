"""What the modules of a QR code must be, given its text and what was sampled of it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import segno
from numpy.typing import NDArray

from server.vision.markers.qr_format import read_format

SAME_CODE_AGREEMENT = 0.8
"""Codes of different content agree in about two thirds of their modules (half of the data and
all of the fixed patterns); a damaged code agrees with its sound version in more than this."""


def exact_modules(payload: str, sampled: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Encode the text again as the sampled code's size, level and mask say.

    The sampled modules are those before error correction: dirt and covers are wrong in them.
    The code that its maker printed is known exactly where another encoder makes the same of
    the text; where it would not (other segments or character sets), the sampled modules are the
    best there is.

    Args:
        payload: Text of the code.
        sampled: Modules as seen, True is black, shape (n, n).

    Returns:
        Modules, shape (n, n).
    """
    level, mask = read_format(sampled)
    version = (sampled.shape[0] - 17) // 4
    encoded = _encoded(payload, version, level, mask)
    if encoded is None or float(np.mean(encoded == sampled)) < SAME_CODE_AGREEMENT:
        return sampled
    return encoded


@lru_cache(maxsize=64)
def _encoded(payload: str, version: int, level: str, mask: int) -> NDArray[np.bool_] | None:
    """The code of a text; None if it does not fit."""
    try:
        code = segno.make(
            payload, version=version, error=level, mask=mask, boost_error=False, micro=False
        )
    except (ValueError, UnicodeError):  # too long, or nothing at all
        return None
    modules = np.array(code.matrix, dtype=np.bool_)
    modules.flags.writeable = False  # it is shared through the cache
    return modules
