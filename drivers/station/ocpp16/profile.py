"""The charging profile that limits the current of a connector."""

from __future__ import annotations

from typing import Any

PROFILE_ID = 9180
"""Ours, so that every new limit takes the place of the one before."""


def current_profile(current_a: float) -> dict[str, Any]:
    """A TxDefaultProfile of one period without an end, as the `ocpp` library spells it."""
    return {
        "chargingProfileId": PROFILE_ID,
        "stackLevel": 0,
        "chargingProfilePurpose": "TxDefaultProfile",
        "chargingProfileKind": "Relative",
        "chargingSchedule": {
            "chargingRateUnit": "A",
            "chargingSchedulePeriod": [{"startPeriod": 0, "limit": round(current_a, 1)}],
        },
    }
