"""The hostile campaign in short; ``make hostile`` runs it at length."""

from __future__ import annotations

import pytest

from tests.campaign.hostile.__main__ import broken, report
from tests.campaign.hostile.rounds import attack_in_one_garage


@pytest.mark.parametrize("seed", [3, 11])
def test_nothing_is_pulled_under_load_whatever_the_station_does(seed: int) -> None:
    figures = attack_in_one_garage(seed, 12)
    assert not broken(figures), report(figures)
    assert figures.timings == 12
    assert figures.begun >= 6
