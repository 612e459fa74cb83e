"""The format information of a QR code: level, mask, and whether it is seen in a mirror.

ISO/IEC 18004, 7.9: fifteen bits (level and mask, protected by a BCH code) stand twice around the
finder patterns, plus one module that is always dark. Finder and timing patterns look the same
in a mirror; these bits do not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_GENERATOR = 0x537
_MASK = 0x5412


def _valid_words() -> NDArray[np.bool_]:
    """All 32 format words as bits, least significant first, shape (32, 15)."""
    words = []
    for data in range(32):
        remainder = data << 10
        for shift in range(14, 9, -1):
            if remainder >> shift & 1:
                remainder ^= _GENERATOR << (shift - 10)
        words.append((data << 10 | remainder) ^ _MASK)
    return (np.array(words)[:, None] >> np.arange(15) & 1).astype(np.bool_)


_WORDS = _valid_words()


_LEVELS = "mlhq"
"""Error correction levels in the order of their two bits."""


def is_mirrored(modules: NDArray[np.bool_]) -> bool:
    """Whether the matrix (True is black, shape (n, n)) makes more sense when transposed."""
    return _format_errors(modules.T) < _format_errors(modules)


def read_format(modules: NDArray[np.bool_]) -> tuple[str, int]:
    """Error correction level ("l", "m", "q" or "h") and mask (0 to 7) that fit best."""
    data = int(_wrong_bits(modules).argmin())
    return _LEVELS[data >> 3], data & 7


def _format_errors(modules: NDArray[np.bool_]) -> int:
    """Smallest number of wrong bits among both copies of the format word and the dark module."""
    return int(_wrong_bits(modules).min()) + int(not modules[modules.shape[0] - 8, 8])


def _wrong_bits(modules: NDArray[np.bool_]) -> NDArray[np.int_]:
    """Wrong bits of both copies for each of the 32 format words, shape (32,)."""
    size = modules.shape[0]
    first = np.concatenate(
        (modules[:6, 8], modules[7:9, 8], modules[8, 7:8], modules[8, 5::-1]),
    )
    second = np.concatenate((modules[8, : size - 9 : -1], modules[size - 7 :, 8]))
    wrong = np.sum(first != _WORDS, axis=1) + np.sum(second != _WORDS, axis=1)
    return np.asarray(wrong, dtype=np.int_)
