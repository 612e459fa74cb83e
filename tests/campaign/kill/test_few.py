"""A few real deaths; ``make kill`` has two hundred."""

from __future__ import annotations

import pytest

from tests.campaign.kill.story import tell

SPEED = 20.0


@pytest.mark.parametrize(("seed", "kills"), [(9, 3), (1004, 3)])
def test_a_server_that_is_killed_finishes_its_job(seed: int, kills: int) -> None:
    story = tell(seed, kills, SPEED)
    assert story.broken == []
    assert story.kills
