"""Which modules a code must have, from its text and from what was seen."""

from __future__ import annotations

import numpy as np
import pytest
import segno
from numpy.typing import NDArray

from server.vision.markers.qr_format import read_format
from server.vision.markers.qr_modules import exact_modules
from tests.server.vision.pictures import PAYLOAD
from twin.qr_label import label_modules


def made(text: str, **settings: object) -> NDArray[np.bool_]:
    code = segno.make(text, boost_error=False, micro=False, **settings)  # type: ignore[arg-type]  # any of segno's
    return np.array(code.matrix, dtype=np.bool_)


def damaged(modules: NDArray[np.bool_], share: float, seed: int = 0) -> NDArray[np.bool_]:
    rng = np.random.default_rng(seed)
    return np.asarray(modules ^ (rng.random(modules.shape) < share))


@pytest.mark.parametrize("level", ["l", "m", "q", "h"])
@pytest.mark.parametrize("mask", range(8))
def test_level_and_mask_are_read_in_spite_of_damage(level: str, mask: int) -> None:
    modules = made("car 42", version=3, error=level, mask=mask)
    assert read_format(modules) == (level, mask)
    assert read_format(damaged(modules, 0.06, mask)) == (level, mask)


@pytest.mark.parametrize(("version", "level", "mask"), [(2, "q", 1), (4, "h", 6), (7, "m", 0)])
def test_damage_is_mended(version: int, level: str, mask: int) -> None:
    modules = made("car 42", version=version, error=level, mask=mask)
    np.testing.assert_array_equal(exact_modules("car 42", damaged(modules, 0.08)), modules)


def test_our_own_label_is_known_exactly() -> None:
    modules = label_modules(PAYLOAD)
    np.testing.assert_array_equal(exact_modules(PAYLOAD, damaged(modules, 0.1)), modules)


def test_a_code_that_another_encoder_made_differently_is_taken_as_seen() -> None:
    """Bytes instead of digits: same text, other modules."""
    seen = made("0123456789", version=2, error="q", mask=3, mode="byte")
    np.testing.assert_array_equal(exact_modules("0123456789", seen), seen)


def test_a_text_that_does_not_fit_is_taken_as_seen() -> None:
    seen = made("short", version=1, error="h")
    np.testing.assert_array_equal(exact_modules("x" * 300, seen), seen)
    np.testing.assert_array_equal(exact_modules("", seen), seen)
