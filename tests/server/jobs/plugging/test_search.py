from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.config.insertion import InsertionSettings
from server.jobs.approach import AT_THE_CENTRE
from server.jobs.plugging.search import further_tries


@given(tries=st.integers(0, 8), radius_mm=st.floats(0, 3))
def test_the_search_is_bounded_and_begins_at_the_measured_centre(
    tries: int, radius_mm: float
) -> None:
    settings = InsertionSettings(search_tries=tries, search_radius_mm=radius_mm)
    offsets = list(further_tries(settings))
    assert len(offsets) == tries
    assert offsets[:1] == [AT_THE_CENTRE][:tries]
    assert all(math.hypot(*offset) <= math.sqrt(2) * radius_mm + 1e-9 for offset in offsets)


@pytest.mark.parametrize("angle_deg", range(0, 360, 90))
def test_a_socket_two_millimetres_away_is_within_the_chamfer_of_one_try(angle_deg: int) -> None:
    """The chamfer takes up 1.5 mm."""
    x_mm, y_mm = (2.0 * f(math.radians(angle_deg)) for f in (math.cos, math.sin))
    offsets = list(further_tries(InsertionSettings()))
    assert min(math.dist((x_mm, y_mm), offset) for offset in offsets) < 1.3
