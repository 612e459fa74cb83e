"""Telling a code from its mirror image."""

from __future__ import annotations

import numpy as np
import pytest
import segno

from server.vision.markers.qr_format import is_mirrored


@pytest.mark.parametrize("version", [1, 2, 7, 25])
@pytest.mark.parametrize("error", ["l", "m", "q", "h"])
@pytest.mark.parametrize("mask", range(8))
def test_every_level_and_mask_is_told_from_its_mirror_image(
    version: int, error: str, mask: int
) -> None:
    code = segno.make("12", version=version, error=error, mask=mask, boost_error=False)
    modules = np.array(code.matrix, dtype=np.bool_)
    assert not is_mirrored(modules)
    assert is_mirrored(modules.T)


def test_some_damage_to_the_format_bits_does_no_harm() -> None:
    modules = np.array(segno.make("12", version=2, error="q", mask=3).matrix, dtype=np.bool_)
    modules[8, :3] ^= True
    assert not is_mirrored(modules)
    assert is_mirrored(modules.T)
