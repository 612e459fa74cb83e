from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulator.charging import PowerRamp

ramps = st.builds(
    PowerRamp,
    st.floats(0, 1e5),
    st.floats(100, 22_000),
    st.floats(0.1, 10),
    st.floats(0, 22_000),
)


def test_energy_of_a_ramp_and_an_hour() -> None:
    ramp = PowerRamp(10.0, 7360.0, 2.0)
    assert ramp.power_w(9.0) == 0.0
    assert ramp.power_w(11.0) == pytest.approx(3680.0)
    assert ramp.power_w(50.0) == 7360.0
    # the ramp lacks half its duration
    assert ramp.energy_wh(10.0 + 3600.0) == pytest.approx(7360.0 * (3600.0 - 1.0) / 3600.0)


@given(ramps, st.floats(0.001, 50_000))
def test_the_time_for_an_energy_is_when_it_has_flowed(ramp: PowerRamp, energy_wh: float) -> None:
    assert ramp.energy_wh(ramp.reaches_s(energy_wh)) == pytest.approx(energy_wh, rel=1e-4, abs=1e-4)
