"""Examples of what crosses the network about arriving cars, for the OpenAPI document."""

from __future__ import annotations

from typing import Any

Json = Any

ARRIVAL_MODELS: dict[str, Json] = {
    "Guidance": {
        "state": "move",
        "since": "2026-03-01T18:01:12.000Z",
        "arriving": True,
        "headline": "Forward 28 cm",
        "detail": "Renault Zoe",
        "remedy": "",
        "steps": [{"direction": "forward", "distance_mm": 283.4, "shown_cm": 28}],
        "car": {
            "vehicle_id": "zoe",
            "x_mm": 612.0,
            "y_mm": 334.0,
            "z_mm": 540.4,
            "sigma_x_mm": 1.1,
            "sigma_z_mm": 2.3,
            "correlation_xz": 0.1,
            "velocity_x_mm_s": 0.4,
            "velocity_z_mm_s": -140.0,
            "still": False,
            "skew_deg": 1.2,
            "skew_sigma_deg": 0.4,
            "turned_deg": 1.0,
            "distance_mm": 590.0,
            "margin_mm": -283.4,
            "seen_at": "2026-03-01T18:01:14.920Z",
        },
        "zones": {
            "good": [[560.0, 190.0], [700.0, 190.0], [700.0, 257.0], [560.0, 257.0]],
            "reachable": [[540.0, 180.0], [720.0, 180.0], [720.0, 270.0], [540.0, 270.0]],
            "stop_z_mm": 223.5,
        },
        "driver_faces": "robot",
        "max_skew_deg": 4.0,
    },
    "SimulatedCarNow": {
        "x_mm": 612.0,
        "y_mm": 334.0,
        "z_mm": 540.4,
        "speed_mm_s": 140.0,
        "moving": True,
    },
}
"""By the name of the schema."""

ARRIVAL_REQUESTS: dict[str, dict[str, Json]] = {
    "commandSimulatedCar": {
        "drive_in": {
            "summary": "Come in from 3.5 m away and stop 5 cm short",
            "value": {"type": "drive_in", "from_mm": 3500, "past_mm": -50},
        },
        "drive_on": {
            "summary": "Go on 5 cm",
            "value": {"type": "drive_on", "forward_mm": 50},
        },
        "brake": {"summary": "Stop now", "value": {"type": "brake"}},
        "leave": {"summary": "Leave", "value": {"type": "leave"}},
    },
}
"""Operations with more than one example, by operation."""
