"""Switch, belt and play, with sigmas that hold the truth."""

import numpy as np
import pytest

from server.calibration.axes.estimates import belt_scale, play, spread_between, switch_spread


def test_the_spread_of_a_switch_is_found_with_its_own_doubt() -> None:
    rng = np.random.default_rng(1)
    found = [switch_spread(100.0 + 0.01 * rng.normal(size=10)) for _ in range(400)]
    assert np.mean([one.value for one in found]) == pytest.approx(0.01, rel=0.05)
    assert np.std([one.value for one in found]) == pytest.approx(
        np.mean([one.sigma for one in found]), rel=0.15
    )


def test_a_belt_that_goes_half_a_percent_too_far() -> None:
    found = belt_scale(400.0, 402.0, 0.1)
    assert found.value == pytest.approx(1.005)
    assert found.sigma == pytest.approx(0.1 * 2**0.5 / 400)
    assert belt_scale(-400.0, -402.0, 0.1) == found


def test_play_is_what_a_reversal_loses() -> None:
    rng = np.random.default_rng(2)
    off = [
        (found.value - 0.3) / found.sigma
        for found in (
            play(-0.15 + 0.01 * rng.normal(size=12), 0.15 + 0.01 * rng.normal(size=12))
            for _ in range(300)
        )
    ]
    assert abs(np.mean(off)) < 0.2
    assert np.std(off) == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: switch_spread(np.zeros(2)), "2 approaches of the switch"),
        (lambda: play(np.zeros(3), np.zeros(1)), "1 approaches from above"),
        (lambda: belt_scale(0.0, 1.0, 0.1), "greater than zero"),
    ],
)
def test_too_little_is_refused(call: object, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        call()  # type: ignore[operator]  # each is a function without arguments


def test_what_differs_between_groups_is_told_from_what_differs_within() -> None:
    rng = np.random.default_rng(4)
    found = [
        spread_between(rng.normal(0.0, 0.1, (8, 1)) + rng.normal(0.0, 0.05, (8, 2))).value
        for _ in range(400)
    ]
    assert np.sqrt(np.mean(np.square(found))) == pytest.approx(0.1, rel=0.06)
    alone = [spread_between(rng.normal(0.0, 0.05, (8, 2))).value for _ in range(400)]
    assert np.mean(alone) < 0.025
    with pytest.raises(ValueError, match="at least 3"):
        spread_between(np.zeros((2, 2)))
    with pytest.raises(ValueError, match="at least 2"):
        spread_between(np.zeros((4, 1)))
