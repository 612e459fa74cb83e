"""What proves that the plug may be pulled."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from drivers.station import PilotState, StationCapabilities, StationSnapshot
from server.control.load_rule import why_not_safe

FRESH_S = 1.0

ALL = StationCapabilities(switches=True, holds=True, unlocks=True)
READ_ONLY = StationCapabilities(switches=False, holds=False, unlocks=False)

SAFE = StationSnapshot(
    sampled_at_s=100.0,
    pilot=PilotState.B,
    enabled=False,
    held=True,
    contactor_closed=False,
    connector_locked=False,
    power_w=0.0,
    currents_a=(0.0, 0.1, 0.0),
    session_energy_wh=5000.0,
)


@pytest.mark.parametrize(
    ("change", "capabilities", "age_s", "code"),
    [
        ({}, ALL, 0.0, None),
        ({}, ALL, FRESH_S, None),
        ({}, ALL, FRESH_S + 0.01, "station_unsafe"),
        ({"pilot": PilotState.C}, ALL, 0.0, "under_load"),
        ({"pilot": PilotState.D}, ALL, 0.0, "under_load"),
        ({"contactor_closed": True}, ALL, 0.0, "under_load"),
        ({"currents_a": (0.0, 0.0, 0.5)}, ALL, 0.0, "under_load"),
        ({"enabled": True}, ALL, 0.0, "under_load"),  # may begin at any moment
        ({"enabled": True, "pilot": PilotState.A}, ALL, 0.0, None),  # sees no car to give it to
        ({"enabled": True}, READ_ONLY, 0.0, None),  # is never anything else
        ({"contactor_closed": True}, READ_ONLY, 0.0, "under_load"),
    ],
)
def test_why_not_safe(
    change: dict[str, Any], capabilities: StationCapabilities, age_s: float, code: str | None
) -> None:
    problem = why_not_safe(
        replace(SAFE, **change),
        capabilities,
        SAFE.sampled_at_s + age_s,
        age_limit_s=FRESH_S,
    )
    assert (problem.code if problem else None) == code
