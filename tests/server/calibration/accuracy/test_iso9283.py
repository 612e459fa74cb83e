"""Accuracy and repeatability of one place, against numbers worked out by hand."""

import math

import numpy as np
import pytest

from server.calibration.accuracy.iso9283 import place_result

CENTRE = np.array([650.0, 335.0])


def test_a_square_of_hits() -> None:
    """Hits 0.1 mm off in four directions about a mean that is 0.5 mm away: all l equal, S_l 0."""
    hits = CENTRE + (0.3, 0.4) + 0.1 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    found = place_result(CENTRE, {"left": hits})
    assert found.accuracy_mm == pytest.approx(0.5)
    assert found.repeatability_mm == pytest.approx(0.1)
    assert found.direction_variation_mm == 0
    assert found.approaches == 4


def test_a_line_of_hits() -> None:
    """l = 0.3, 0, 0.3: mean 0.2, S_l = sqrt(0.03), RP = 0.2 + 3 S_l."""
    hits = CENTRE + np.array([[-0.3, 0.0], [0.0, 0.0], [0.3, 0.0]])
    found = place_result(CENTRE, {"left": hits})
    assert found.accuracy_mm == pytest.approx(0, abs=1e-12)
    assert found.repeatability_mm == pytest.approx(0.2 + 3 * math.sqrt(0.03))


def test_play_shows_as_variation_between_directions() -> None:
    hits = CENTRE + np.zeros((3, 2))
    shift = np.array([0.1, 0.0])
    found = place_result(CENTRE, {"left": hits - shift, "right": hits + 2 * shift})
    assert found.direction_variation_mm == pytest.approx(0.3)
    assert found.accuracy_mm == pytest.approx(0.05)


def test_two_hits_say_nothing_about_repeating() -> None:
    with pytest.raises(ValueError, match="2 approaches from left; at least 3"):
        place_result(CENTRE, {"left": np.zeros((2, 2))})
